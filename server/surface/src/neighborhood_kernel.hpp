#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/neighbors.hpp"
#include "physics/particles.hpp"

namespace pelagos {

/// Weighted sums over the neighbours of the 16 particles of a group: w = 1 - (r/h)^3 and w (x_j - x_i).
struct alignas(64) GroupSums {
  float weight[kLanes];
  float x[kLanes], y[kLanes], z[kLanes];
};

/// Adds the slots `range` of `slots` to `sums`. Neighbours at support_radius or farther, the dummy and neighbours that
/// are not finite add nothing. Sums of a lane run in slot order, so the bits depend neither on what else is in its
/// group nor on the instruction set.
/// @param query      the group's 16 positions
/// @param neighbors  positions that the slots index
void add_slots(const Float4* query, const Float4* neighbors, const std::int32_t* slots, NeighborList::SlotRange range,
               float support_radius, GroupSums& sums);

/// Sums over the neighbours of one particle, for its shape and its foam.
struct ParticleSums {
  float weight = 0;                                      ///< sum of w
  float x = 0, y = 0, z = 0;                             ///< sums of w r, r = x_j - x_i
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< sums of w r r^T
  float closing = 0;         ///< m/s, sum of (1 - |r|/h) (|v| - v.r/|r|), v = v_j - v_i; fluid neighbours at a distance
  float closing_weight = 0;  ///< sum of (1 - |r|/h) of the same
};

/// Adds the neighbours of particle i of `list`, four at a time; what is too far or no number adds nothing. The bits do
/// not depend on the instruction set.
/// @param own, own_velocity      of particle i
/// @param neighbors, velocities  that the list indexes; velocities may be null: then nothing is added to `closing`
void add_neighbors(const Float4& own, const Float4& own_velocity, const Float4* neighbors, const Float4* velocities,
                   const NeighborList& list, std::size_t i, float support_radius, ParticleSums& sums);

}  // namespace pelagos
