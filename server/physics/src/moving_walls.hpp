#pragma once

#include "physics/fluid.hpp"

namespace pelagos {

/// Puts the samples of bodies that move behind the static walls, in cell order, each with the body that it belongs to.
/// Samples of bodies that answer the water have no velocity of their own: the coupling adds what these bodies do.
void sort_moving_walls(TaskPool& pool, FluidState& state);

}  // namespace pelagos
