#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/neighbor_search.hpp"
#include "slot_claims.hpp"

namespace pelagos {

/// Neighbours that a row of the fast path holds; a whole vector more is written past the end.
inline constexpr std::size_t kRowCapacity = 96;
inline constexpr std::size_t kRowStride = kRowCapacity + kLanes;
/// Candidates are padded to whole vectors with points this far away.
inline constexpr float kFar = 1e9F;

/// What one search works on; shared by all blocks.
struct SearchJob {
  const CellGrid* query_grid;
  std::span<const Float4> query;
  std::span<const SearchSource> sources;
  float support_radius;
  std::int32_t dummy;
  NeighborList* list;
  std::size_t slot_capacity;
  std::size_t shares;  ///< parts of the work for which slots are claimed apart, as many as threads
  SlotClaims* claims;

  /// The share of a group: the pool deals work to its threads in such equal ranges.
  [[nodiscard]] std::size_t share_of(std::size_t group) const { return group * shares / list->groups.size(); }
};

/// Coordinates of all points of 27 cells relative to the middle cell's centre, in separate arrays.
struct Candidates {
  std::vector<float> x, y, z, squared;
  std::vector<std::int32_t> index;
  std::size_t count = 0;

  void reserve(std::size_t wanted) {
    if (x.size() >= wanted) return;
    const std::size_t size = wanted + wanted / 2;
    for (std::vector<float>* v : {&x, &y, &z, &squared}) v->resize(size);
    index.resize(size);
  }
};

struct SearchScratch {
  Candidates candidates;
  alignas(64) std::array<std::int32_t, kLanes * kRowStride> rows;
  std::array<std::uint32_t, kLanes> length;
};

/// Points that stand together in a source: three cells side by side.
struct Run {
  const Float4* position;
  std::uint32_t first, last, index_offset;
};
/// The runs of points in the 27 cells around a cell, of at most kMaxSources sources.
inline constexpr std::size_t kMaxSources = 2;
struct RunList {
  std::array<Run, 9 * kMaxSources> run;
  std::size_t count = 0, points = 0;
};
inline RunList find_runs(const SearchJob& job, const std::array<int, 3>& cell) {
  const CellGrid& grid = *job.query_grid;
  RunList runs;
  const int x0 = std::max(cell[0] - 1, 0), x1 = std::min(cell[0] + 1, grid.cells_x() - 1);
  for (const SearchSource& source : job.sources) {
    if (!source.grid->may_be_near(grid.cell_index(cell[0], cell[1], cell[2]))) continue;
    const std::uint32_t* begin = source.grid->begin().data();
    for (int z = std::max(cell[2] - 1, 0); z <= std::min(cell[2] + 1, grid.cells_z() - 1); ++z)
      for (int y = std::max(cell[1] - 1, 0); y <= std::min(cell[1] + 1, grid.cells_y() - 1); ++y) {
        const std::uint32_t first = begin[grid.cell_index(x0, y, z)], last = begin[grid.cell_index(x1, y, z) + 1];
        if (first == last) continue;
        runs.run[runs.count++] = {source.position, first, last, source.index_offset};
        runs.points += last - first;
      }
  }
  return runs;
}

inline Float4 relative_to(const Float4& center, const Float4& p) {
  return {p.x - center.x, p.y - center.y, p.z - center.z, 0.0F};
}

inline std::array<int, 3> cell_coordinates(const CellGrid& grid, std::size_t cell) {
  const auto nx = static_cast<std::size_t>(grid.cells_x()), ny = static_cast<std::size_t>(grid.cells_y());
  return {static_cast<int>(cell % nx), static_cast<int>(cell / nx % ny), static_cast<int>(cell / (nx * ny))};
}

}  // namespace pelagos
