#pragma once

#include "values/scene.hpp"
#include "wind/wind.hpp"

namespace pelagos {

/// What the wind needs to know of a scene. @param origin  m, world: local zero  @param water_level  m, world
inline WindSite wind_site(const Scene& scene, const Eigen::Vector3d& origin, double water_level) {
  return {{origin, water_level, scene.tank.min.z(), scene.seed},
          scene.particle_spacing,
          scene.gravity,
          scene.water.rest_density};
}

}  // namespace pelagos
