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
/// are not finite add nothing.
/// @param query      the group's 16 positions
/// @param neighbors  positions that the slots index
using GroupKernel = void (*)(const Float4* query, const Float4* neighbors, const std::int32_t* slots,
                             NeighborList::SlotRange range, float support_radius, GroupSums& sums);

/// The kernel for the widest instruction set of this machine: AVX-512, AVX2 or plain x86-64. All give the same bits:
/// lanes are independent, sums run in slot order, and multiplications are not fused with additions.
[[nodiscard]] GroupKernel select_group_kernel();

/// Variants by name ("avx512", "avx2", "baseline"), for tests; nullptr where the machine lacks it.
[[nodiscard]] GroupKernel group_kernel(const char* instruction_set);

}  // namespace pelagos
