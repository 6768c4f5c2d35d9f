#pragma once

#include "physics/fluid.hpp"

namespace pelagos {

// The stages that schemes share, in the order in which they usually come.

/// v* = v + dt a;  x* = x + dt v*
void predict(TaskPool& pool, FluidState& state, double dt);
/// Sorts the particles and the moving samples by cell at their present positions.
void sort_particles(TaskPool& pool, FluidState& state);
/// Neighbour lists at the present positions.
void search_neighbors(TaskPool& pool, FluidState& state, StepReport& report);
/// delta, alpha, wall gradients and the gradient cache at the present positions.
void refresh_density(TaskPool& pool, FluidState& state, StepReport& report);
/// The view that pair passes read.
[[nodiscard]] PairData pair_data(const FluidState& state);

void advance_hybrid(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report);

/// The far dummy that pads arrays of positions.
inline constexpr Float4 kFarRecord{1e9F, 1e9F, 1e9F, 0.0F};

/// Particles in one block of pointwise work.
inline constexpr std::size_t kPointBlock = 2048;

}  // namespace pelagos
