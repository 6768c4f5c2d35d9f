#pragma once

#include <optional>
#include <string>

#include "messages/field_reader.hpp"
#include "values/command.hpp"

namespace pelagos::proto::v1 {
class TimedCommand;
}

namespace pelagos {

/// Where a command stands. It decides which may be given and which fields beside them have a meaning.
enum class CommandPlace {
  kNow,    ///< over the control link, for the next step boundary
  kTimed,  ///< over the control link or in a scene, with a time
  kLog,    ///< in a command log
};

/// Reads the command that is set in a oneof of a message: TimedCommand's `command`, or Request's `body`, whose older
/// fields are commands too. Faults are noted with the field's path. Nothing if none is set or it is no command.
[[nodiscard]] std::optional<Command> read_command(const FieldReader& reader, const char* oneof, CommandPlace place);

/// Whether read_command knows the field as a command.
[[nodiscard]] bool is_command(const std::string& field);

/// The same as a message: read back, it is bit for bit the same.
void write_command(const Command& command, proto::v1::TimedCommand& message);

/// s of simulated time that a command may be given for.
inline constexpr Range kCommandTimes{0.0, 1e9, "s"};

}  // namespace pelagos
