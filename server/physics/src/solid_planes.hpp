#pragma once

#include "physics/fluid.hpp"

namespace pelagos {

/// Tangent planes of all particles and images at the present positions, after the search. Nothing without solids.
void find_solid_planes(TaskPool& pool, FluidState& state);

/// The body whose surface a particle has in a slot, or -1.
[[nodiscard]] std::int32_t body_in_slot(const FluidState& state, std::size_t slot, std::size_t i);

/// rate -= what the floor's own motion does to the density.
void add_floor_speeds(TaskPool& pool, const FluidState& state, std::span<float> rate);

/// Speeds of the surfaces from the bodies' present velocities and the floor, into the planes.
void refresh_solid_speeds(TaskPool& pool, FluidState& state);

/// Gives the bodies what the filter has taken from the water through their surfaces' images.
/// @param factor  on the filter's change
void give_filter_to_bodies(TaskPool& pool, FluidState& state, float factor);

/// Puts particles that have come into a solid back: as far outside as they were inside, at most half a spacing, with
/// the approaching speed reversed. The body takes the impulse. Nothing without solids.
void push_out_of_solids(TaskPool& pool, FluidState& state);

}  // namespace pelagos
