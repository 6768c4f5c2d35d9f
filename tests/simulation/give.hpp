#pragma once

#include <optional>
#include <string>

#include "simulation/world.hpp"

namespace pelagos::test {

/// Gives a world one command, without a step. @return why it was refused; nothing where it was done
inline std::optional<std::string> give(World& world, const Command& command) {
  const CommandOutcome outcome = world.take({{}, {{command, "test"}}}).front();
  return outcome.refusal ? std::optional(to_string(*outcome.refusal)) : std::nullopt;
}

inline void give(World& world, const BodyPose& pose) { world.take({{{pose, "test"}}, {}}); }

}  // namespace pelagos::test
