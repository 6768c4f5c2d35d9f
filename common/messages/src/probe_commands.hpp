#pragma once

#include "messages/read_probe.hpp"
#include "values/probe.hpp"

namespace pelagos::proto::v1 {
class TimedCommand;
}

namespace pelagos {

// The commands that concern probes: out of their messages, and back.

[[nodiscard]] RemoveProbe read_remove_probe(const FieldReader& reader);
void write_probe(const SetProbe& command, proto::v1::TimedCommand& message);
void write_probe(const RemoveProbe& command, proto::v1::TimedCommand& message);

}  // namespace pelagos
