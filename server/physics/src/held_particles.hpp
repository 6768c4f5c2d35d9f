#pragma once

#include <span>

#include "physics/fluid.hpp"

namespace pelagos {

// What the stages of a step do with held particles. Nothing in seas without them.

/// Puts them where they are given, with the velocity that is given.
void place_held(FluidState& state);
/// Gives them no row in the coming solve, and a density that is no compression.
void leave_held_out(FluidState& state);
/// Their pressures in a velocity solve over dt.
[[nodiscard]] std::span<const float> held_pressures(FluidState& state, double dt);
/// Takes out what the filter would change of their velocities.
void keep_held_velocities(FluidState& state);

}  // namespace pelagos
