#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "values/command.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// What a scene offers to commands: where they may put things, and on what.
struct CommandSite {
  Box tank;                           ///< m, world
  std::vector<std::uint32_t> bodies;  ///< ids
  std::optional<OilModel> oil;        ///< none: the scene has no oil
};

[[nodiscard]] CommandSite command_site(const Scene& scene);

/// Why a command, well-formed by itself, does not fit where it is given.
struct Misfit {
  std::string field;  ///< of the command's message, e.g. "from"; empty: the command as a whole
  std::string what;   ///< the value and what is allowed
};

/// @return what the scene alone tells against the command: places outside the tank, bodies that are not there, oil that
///         the scene has not; nothing if it fits. The world may still refuse it for its present state.
[[nodiscard]] std::optional<Misfit> find_misfit(const Command& command, const CommandSite& site);

/// On one line: field and what.
[[nodiscard]] std::string to_string(const Misfit& misfit);

}  // namespace pelagos
