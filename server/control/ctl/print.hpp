#pragma once

#include <google/protobuf/message.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "control.pb.h"

namespace pelagos {

/// Any message as JSON: fields under their names in the .proto file, numbers as numbers (NaN and infinities as null),
/// enums by name, fields that are absent left out, repeated ones always there.
[[nodiscard]] nlohmann::ordered_json to_json(const google::protobuf::Message& message);

/// A status on a handful of lines, for people.
[[nodiscard]] std::string describe(const proto::v1::Status& status);
/// The commands that wait, one a line: id, time, what, who; a line of its own if there are none.
[[nodiscard]] std::string describe(const proto::v1::Schedule& schedule);
/// What anemometers read, a line for each.
[[nodiscard]] std::string describe(const proto::v1::WindReading& reading);
/// An event on one line.
[[nodiscard]] std::string describe(const proto::v1::Event& event);

}  // namespace pelagos
