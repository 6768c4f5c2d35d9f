#pragma once

#include "values/patch_frame.hpp"
#include "values/scene.hpp"
#include "wind/wind.hpp"

namespace pelagos {

/// What the wind needs to know of a scene. @param frame  of the patch  @param water_level  m, world
inline WindSurroundings wind_surroundings(const Scene& scene, const PatchFrame& frame, double water_level) {
  return {{frame, water_level, scene.seed}, scene.particle_spacing, scene.gravity, scene.water.rest_density};
}

}  // namespace pelagos
