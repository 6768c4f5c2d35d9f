#pragma once

#include "simulation/world.hpp"

namespace pelagos {

/// Lets tests put faults and waves into a world's water.
struct WorldTestAccess {
  static FluidState& fluid(World& world) {
    world.water_surface_.forget();
    return world.fluid_;
  }
};

}  // namespace pelagos
