#pragma once

#include <span>

#include "physics/fluid.hpp"

namespace pelagos {

/// Physical pressure of every particle after a step, Pa; zero before the first one.
///   hybrid, dfsph, pbf:  P = rho0 (p_density + p_divergence) / dt^2, both constraints push the water
///   corrected:           P = rho0 p_velocity / dt^2, of the velocity solve alone: the repair of positions is no force
/// The density constraint's part is the one that the particles carry, a mean over about five steps (see
/// solve_constraint); the velocity solve's is the one that acted in this step.
/// @param pressure  out, [particles.count], in the present order of the particles
void compute_pressure(const FluidState& state, std::span<float> pressure);

}  // namespace pelagos
