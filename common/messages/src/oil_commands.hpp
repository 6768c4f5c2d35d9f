#pragma once

#include "messages/field_reader.hpp"
#include "values/command.hpp"

namespace pelagos::proto::v1 {
class TimedCommand;
}

namespace pelagos {

// The commands that concern oil, out of their messages and back. proto/commands.proto states the ranges.

[[nodiscard]] OilCommand read_release_oil(const FieldReader& reader);
[[nodiscard]] OilCommand read_stop_release(const FieldReader& reader);
[[nodiscard]] OilCommand read_spill_oil(const FieldReader& reader);
[[nodiscard]] OilCommand read_set_boom(const FieldReader& reader);
[[nodiscard]] OilCommand read_remove_boom(const FieldReader& reader);
[[nodiscard]] OilCommand read_set_skimmer(const FieldReader& reader);
[[nodiscard]] OilCommand read_remove_skimmer(const FieldReader& reader);

void write_oil(const OilCommand& command, proto::v1::TimedCommand& message);

}  // namespace pelagos
