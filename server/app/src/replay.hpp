#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "command_queue.hpp"
#include "scene/command_log.hpp"

namespace pelagos {

/// The commands of a log, given again before the steps before which they were applied.
class Replay {
 public:
  explicit Replay(CommandLog log) : log_(std::move(log)) {}

  /// What differs between the run that was logged and this one so that its bits cannot be repeated; empty if nothing.
  /// @param now  of this run
  [[nodiscard]] std::string mismatch(const CommandLogHeader& now) const;
  /// What may make the bits differ all the same, for a warning; empty if nothing.
  [[nodiscard]] std::string doubt(const CommandLogHeader& now) const;

  /// Appends the commands for a boundary after `step` steps to `out`. Those that steer the clock are left out: a replay
  /// does not pause.
  void take(std::uint64_t step, std::vector<QueuedCommand>& out);

  /// Whether the logged run had ended after so many steps. Never for a log that was cut off.
  [[nodiscard]] bool ended(std::uint64_t step) const { return log_.end && step >= log_.end->step; }
  [[nodiscard]] const CommandLog& log() const { return log_; }

 private:
  CommandLog log_;
  std::size_t next_ = 0;
};

/// Whether a command changes the water, and not only when it is computed.
[[nodiscard]] bool changes_water(const Command& command);

}  // namespace pelagos
