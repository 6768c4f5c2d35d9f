#pragma once

#include <optional>

#include "simulation/world.hpp"
#include "values/scene.hpp"
#include "values/status.hpp"
#include "wind/air.hpp"

namespace pelagos {

/// The status of a scene whose water has not been placed: what the scene sets. @param sea  make_scene_sea of the scene
[[nodiscard]] ServerStatus starting_status(const Scene& scene, const SceneSea& sea);

/// The air over such a scene. The mean level is the top of the highest block of water.
[[nodiscard]] std::optional<Air> starting_air(const Scene& scene);

/// Fills in what a world holds now; oil is left to the caller, as its figures cost a sort.
void fill_from(const World& world, ServerStatus& status);

}  // namespace pelagos
