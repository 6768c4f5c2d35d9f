#pragma once

#include <string>

#include "values/command.hpp"

namespace pelagos {

/// A command in words, for events and logs.
struct CommandNews {
  std::string kind;  ///< of the event, see proto/control.proto
  std::string text;  ///< one line
};
[[nodiscard]] CommandNews describe_command(const Command& command);

}  // namespace pelagos
