#pragma once

#include <cstddef>

#include "physics/pair_passes.hpp"

namespace pelagos {

/// 256 particles a block: small enough to balance two cores, large enough to amortise the claim.
inline constexpr std::size_t kGroupsPerBlock = 16;

/// Calls f(first_group, last_group) for all groups of particles, on all threads.
template <class F>
void for_each_group(TaskPool& pool, const PairData& data, F&& f) {
  pool.for_each_range(data.fluid->groups.size(), kGroupsPerBlock, f);
}

/// Entries of an array that pair loops gather: images included.
inline std::size_t gathered_count(const PairData& data) {
  return data.ghosts ? extended_count(data.count, *data.ghosts) : padded_count(data.count);
}

}  // namespace pelagos
