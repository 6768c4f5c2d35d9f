#pragma once

#include "values/scene.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

/// The waves around the patch at the start of a scene. @param water_level  m, world, of the water at rest
[[nodiscard]] WaveField scene_sea(const Scene& scene, double water_level);

}  // namespace pelagos
