#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scene/command_log.hpp"
#include "values/step_inputs.hpp"

namespace pelagos {

/// The inputs of a logged run, given again before the steps before which they took effect.
class Replay {
 public:
  explicit Replay(CommandLog log) : log_(std::move(log)) {}

  /// What differs between the run that was logged and this one so that its bits cannot be repeated; empty if nothing.
  /// @param now  of this run
  [[nodiscard]] std::string mismatch(const CommandLogHeader& now) const;
  /// What may make the bits differ all the same, for a warning; empty if nothing.
  [[nodiscard]] std::string doubt(const CommandLogHeader& now) const;

  /// Appends the poses and commands for a boundary after `step` steps to `inputs`. Those that steer the clock are left
  /// out: a replay does not pause.
  void take(std::uint64_t step, StepInputs& inputs);

  /// Whether the log holds the hash of the state after so many steps. Steps never decrease from call to call.
  [[nodiscard]] bool check_due(std::uint64_t step);
  /// Holds the state's hash after `step` steps against the log's. @return at the first difference what it is
  [[nodiscard]] std::string check(std::uint64_t step, std::uint64_t world_hash);
  /// What the checks have found so far, for people.
  [[nodiscard]] std::string checks_text() const;

  /// Whether the log has nothing more after so many steps: the logged run had ended, or was cut off.
  [[nodiscard]] bool ended(std::uint64_t step) const { return step >= last_step(); }
  /// Whether a state differed from that of the logged run.
  [[nodiscard]] bool differs() const { return first_difference_.has_value(); }
  [[nodiscard]] const CommandLog& log() const { return log_; }

 private:
  [[nodiscard]] std::string other_start(const CommandLogHeader& now) const;
  [[nodiscard]] std::uint64_t last_step() const;

  CommandLog log_;
  std::size_t next_command_ = 0, next_pose_ = 0, next_check_ = 0;
  std::uint64_t checks_made_ = 0;
  std::optional<std::uint64_t> first_difference_;  ///< steps made
};

}  // namespace pelagos
