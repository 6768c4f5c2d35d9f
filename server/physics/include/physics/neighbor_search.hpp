#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/grid.hpp"
#include "physics/neighbors.hpp"
#include "physics/particles.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

/// Points among which neighbours are looked for: sorted by `grid`; their indices in the list are k + index_offset,
/// where k is the place in the grid's order. `position[k]` holds their coordinates in that order, readable for kLanes
/// entries past the last.
struct SearchSource {
  const CellGrid* grid = nullptr;
  const Float4* position = nullptr;
  std::uint32_t index_offset = 0;
};

struct SearchReport {
  std::uint64_t pairs = 0;      ///< directed pairs found, self pairs included
  std::uint64_t slots = 0;      ///< slots used, each of kLanes entries: padding is slots * kLanes - pairs
  std::uint32_t long_rows = 0;  ///< particles with so many neighbours that they took the slow exact path
  std::uint32_t cut_rows = 0;   ///< particles with more than kLongestRow neighbours, of which the nearest are kept
};

/// No row holds more neighbours: thousands of particles in one place would take memory with the square of their number.
/// Water at rest has about 33. Where rows are cut, pairs may be seen from one side only.
inline constexpr std::size_t kLongestRow = 512;

/// Fills `list` with the neighbours of each query point closer than `support_radius`.
/// @param query       [count] sorted by `query_grid`; all grids have the same region and cell size = support_radius
/// @param sources     where to look, at most two; may be the queries themselves (each then finds itself)
/// @param dummy       index that fills short rows
/// The entries of each particle come in a fixed order (cells, then order within the cell), whatever the number of
/// threads.
SearchReport find_neighbors(TaskPool& pool, const CellGrid& query_grid, std::span<const Float4> query,
                            std::span<const SearchSource> sources, float support_radius, std::int32_t dummy,
                            NeighborList& list);

/// Name of the instruction set that the physics kernels use on this machine, e.g. "AVX3", "AVX2", "SSE4", "EMU128".
[[nodiscard]] const char* instruction_set();

/// Restricts the kernels to at most the named set ("baseline", "sse4", "avx2", "avx512"). For comparisons and tests;
/// call before any kernel has run. False if the name is unknown or the machine does not have it.
[[nodiscard]] bool limit_instruction_set(const char* name);

}  // namespace pelagos
