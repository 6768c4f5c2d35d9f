#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/append_file.hpp"
#include "values/command.hpp"
#include "values/scene_parts.hpp"
#include "values/status.hpp"
#include "values/step_inputs.hpp"

namespace pelagos {

/// What a command log is about; its first lines.
struct CommandLogHeader {
  std::string version;          ///< of the server that wrote it
  std::string instruction_set;  ///< of its physics
  std::string scene;            ///< name
  std::uint64_t seed = 0;
  std::uint64_t particles = 0;
  SceneParts parts = {};  ///< of the scene, and of the state at the start; empty in logs that have none
};

/// A command as it was applied.
struct LoggedCommand {
  std::uint64_t before_step = 0;  ///< steps made before it
  double time = 0.0;              ///< s, simulated, for people
  std::string source;
  Command command;
};

/// A pose as it was taken.
struct LoggedPose {
  std::uint64_t before_step = 0;  ///< steps made before it
  GivenPose given;
};

/// What the whole state was at some time of the logged run.
struct CommandLogCheck {
  std::uint64_t step = 0;  ///< steps made
  double time = 0.0;       ///< s, simulated, for people
  std::uint64_t world_hash = 0;
};

/// How a logged run ended.
struct CommandLogEnd {
  std::uint64_t step = 0;        ///< steps made in all
  std::uint64_t state_hash = 0;  ///< of the water after the last one, see physics/fluid.hpp
};

struct CommandLog {
  CommandLogHeader header;
  std::vector<LoggedCommand> commands;  ///< as applied: steps never decrease
  std::vector<LoggedPose> poses;        ///< as taken: likewise
  std::vector<CommandLogCheck> checks;  ///< likewise
  std::optional<CommandLogEnd> end;     ///< nothing: the run was cut off
  std::string cut_off;                  ///< what was left out because the last line ends in its middle; else empty
};

struct CommandLogResult {
  std::optional<CommandLog> log;
  std::vector<std::string> faults;  ///< as of SceneResult
};

/// Reads a command log (Protobuf text format of `CommandLog` in proto/commands.proto, at most 1 GiB). A last line that
/// was cut off is left out, and told. Never throws for what it holds.
[[nodiscard]] CommandLogResult read_command_log_file(const std::filesystem::path& path);
[[nodiscard]] CommandLogResult read_command_log_text(std::string_view text, const std::string& source_name);

/// Writes a command log line by line, each on its way to the disk at once: whatever was written is a log that can be
/// read, should the program be killed. The log of another run is never overwritten (files/append_file.hpp).
class CommandLogWriter {
 public:
  /// Opens the file. Where one holds something already, file.1 is written, or file.2, ... What failed is told by
  /// `failed`.
  explicit CommandLogWriter(const std::string& file) : file_(file) {}

  void write(const CommandLogHeader& header);  ///< before all else
  void write(const LoggedCommand& command);
  void write(const LoggedPose& pose);
  void write(const CommandLogCheck& check);
  void write(const CommandLogEnd& end);
  /// Tries again to write what waits for room on the disk.
  void flush() { file_.flush(); }
  /// Whether anything waits or was lost.
  [[nodiscard]] bool failed() const { return !file_.fault().empty(); }
  /// The file that is written, what waits and why.
  [[nodiscard]] CommandLogState state() const;

 private:
  AppendFile file_;
};

}  // namespace pelagos
