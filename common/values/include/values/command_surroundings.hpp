#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "text/refusal.hpp"
#include "values/command.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// What a scene offers to commands: where they may put things, and on what.
struct CommandSurroundings {
  Box patch;                          ///< m, world
  std::vector<std::uint32_t> bodies;  ///< ids
  std::optional<OilModel> oil;        ///< none: the scene has no oil
  double gravity = kStandardGravity;  ///< m/s^2, > 0, of waves
};

[[nodiscard]] CommandSurroundings command_surroundings(const Scene& scene);

/// @return what the scene alone tells against the command: places outside the patch, bodies that are not there, oil
/// that
///         the scene has not, waves that would break; nothing if it fits. The world may still refuse it for its present
///         state.
[[nodiscard]] std::optional<Refusal> find_refusal(const Command& command, const CommandSurroundings& around);

}  // namespace pelagos
