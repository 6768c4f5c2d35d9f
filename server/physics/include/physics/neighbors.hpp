#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

/// Neighbours of all query particles within the support radius, laid out for lanes.
/// Group g holds the particles 16 g .. 16 g + 15, one a lane. It owns the slots groups[g].begin .. groups[g].end (there
/// may be gaps between groups); slot s holds 16 indices, slots[16 s + lane]: the k-th neighbour of each particle of the
/// group. Shorter lists are filled up with `dummy`, the index of a far record that contributes nothing. The particle
/// itself is in its own fluid list.
struct NeighborList {
  struct SlotRange {
    std::uint32_t begin = 0, end = 0;
  };
  std::vector<SlotRange> groups;
  std::vector<std::int32_t> slots;
  std::vector<std::uint32_t> pair_count;  ///< [queries padded] neighbours of each particle, without padding
  std::int32_t dummy = 0;
};

/// Calls f(j) for each neighbour of particle i, in the list's fixed order (i itself included in a fluid list).
template <class F>
void for_each_neighbor(const NeighborList& list, std::size_t i, F&& f) {
  const std::size_t group = i / kLanes, lane = i % kLanes;
  const std::int32_t* index = list.slots.data() + list.groups[group].begin * kLanes + lane;
  for (std::uint32_t k = 0; k < list.pair_count[i]; ++k) f(static_cast<std::size_t>(index[k * kLanes]));
}

}  // namespace pelagos
