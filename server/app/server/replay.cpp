#include "replay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "run_clock.hpp"

namespace pelagos {

std::string Replay::mismatch(const CommandLogHeader& now) const {
  const CommandLogHeader& then = log_.header;
  if (then.scene == now.scene && then.seed == now.seed && then.particles == now.particles) return other_start(now);
  return fmt::format(
      "the command log is of scene {} with seed {} and {} particles, this is scene {} with seed {} and {} particles; "
      "replay it with its own scene file",
      then.scene, then.seed, then.particles, now.scene, now.seed, now.particles);
}

/// Other versions and instruction sets may make other parts out of the same scene.
std::string Replay::other_start(const CommandLogHeader& now) const {
  const CommandLogHeader& then = log_.header;
  if (then.parts.empty() || !doubt(now).empty()) return "";
  const std::string other = other_parts(then.parts, now.parts);
  if (other.empty()) return "";
  return fmt::format(
      "the command log is of a run of scene {} that differs in: {}; allowed: the scene as it was then, and the state "
      "file that the run went on from",
      then.scene, other);
}

std::string Replay::doubt(const CommandLogHeader& now) const {
  const CommandLogHeader& then = log_.header;
  if (then.version == now.version && then.instruction_set == now.instruction_set) return "";
  return fmt::format("the command log was written by version {} with {}, this is version {} with {}: bits may differ",
                     then.version, then.instruction_set, now.version, now.instruction_set);
}

void Replay::take(std::uint64_t step, StepInputs& inputs) {
  for (; next_pose_ < log_.poses.size() && log_.poses[next_pose_].before_step <= step; ++next_pose_)
    inputs.poses.push_back({log_.poses[next_pose_].given.pose, "replay of " + log_.poses[next_pose_].given.source});
  for (; next_command_ < log_.commands.size() && log_.commands[next_command_].before_step <= step; ++next_command_) {
    const LoggedCommand& logged = log_.commands[next_command_];
    if (!steers_clock(logged.command)) inputs.commands.push_back({logged.command, "replay of " + logged.source});
  }
}

std::uint64_t Replay::last_step() const {
  if (log_.end) return log_.end->step;
  std::uint64_t last = 0;
  if (!log_.commands.empty()) last = std::max(last, log_.commands.back().before_step);
  if (!log_.poses.empty()) last = std::max(last, log_.poses.back().before_step);
  if (!log_.checks.empty()) last = std::max(last, log_.checks.back().step);
  return last;
}

bool Replay::check_due(std::uint64_t step) {
  while (next_check_ < log_.checks.size() && log_.checks[next_check_].step < step) ++next_check_;
  return next_check_ < log_.checks.size() && log_.checks[next_check_].step == step;
}

std::string Replay::check(std::uint64_t step, std::uint64_t world_hash) {
  if (!check_due(step)) return "";
  const CommandLogCheck& logged = log_.checks[next_check_++];
  ++checks_made_;
  if (logged.world_hash == world_hash || first_difference_) return "";
  first_difference_ = step;
  return fmt::format("the state after step {}, at {:.3f} s, is {:016x}, that of the logged run {:016x}", step,
                     logged.time, world_hash, logged.world_hash);
}

std::string Replay::checks_text() const {
  if (checks_made_ == 0) return "no state of the logged run was there to compare with";
  if (first_difference_)
    return fmt::format("whole states compared: {}; the first that differs is that after step {}", checks_made_,
                       *first_difference_);
  return fmt::format("whole states compared: {}, the same bits", checks_made_);
}

}  // namespace pelagos
