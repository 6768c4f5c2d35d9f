#pragma once

#include "simulation/world.hpp"
#include "values/scene_parts.hpp"

namespace pelagos {

/// What a run that starts now depends on: the parts of the scene, and those of the state, named "wind at the start".
[[nodiscard]] SceneParts run_parts(const World& world);

}  // namespace pelagos
