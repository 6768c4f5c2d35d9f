#include "replay.hpp"

#include <fmt/format.h>

namespace pelagos {

bool changes_water(const Command& command) {
  return !std::holds_alternative<PauseSimulation>(command) && !std::holds_alternative<ResumeSimulation>(command) &&
         !std::holds_alternative<StepSimulation>(command);
}

std::string Replay::mismatch(const CommandLogHeader& now) const {
  const CommandLogHeader& then = log_.header;
  if (then.scene == now.scene && then.seed == now.seed && then.particles == now.particles) return "";
  return fmt::format(
      "the command log is of scene {} with seed {} and {} particles, this is scene {} with seed {} and {} particles; "
      "replay it with its own scene file",
      then.scene, then.seed, then.particles, now.scene, now.seed, now.particles);
}

std::string Replay::doubt(const CommandLogHeader& now) const {
  const CommandLogHeader& then = log_.header;
  if (then.version == now.version && then.instruction_set == now.instruction_set) return "";
  return fmt::format("the command log was written by version {} with {}, this is version {} with {}: bits may differ",
                     then.version, then.instruction_set, now.version, now.instruction_set);
}

void Replay::take(std::uint64_t step, std::vector<QueuedCommand>& out) {
  for (; next_ < log_.commands.size() && log_.commands[next_].before_step <= step; ++next_) {
    const LoggedCommand& logged = log_.commands[next_];
    if (changes_water(logged.command)) out.push_back({logged.command, "replay of " + logged.source});
  }
}

}  // namespace pelagos
