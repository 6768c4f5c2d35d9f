#pragma once

#include <optional>

#include "control.pb.h"
#include "messages/field_reader.hpp"
#include "values/command.hpp"

namespace pelagos {

/// A command request as a validated value; faults are noted with the field's path. Requests that are no commands
/// (hello, status, subscriptions) and faulty ones give nothing.
/// @param present_wind  what fields of set_wind that are left out keep
[[nodiscard]] std::optional<Command> read_command(const proto::v1::Request& request,
                                                  const std::optional<WindSettings>& present_wind, FieldFaults& faults);

}  // namespace pelagos
