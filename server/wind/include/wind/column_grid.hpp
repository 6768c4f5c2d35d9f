#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

/// A horizontal grid over the particles; cell (i, j) has its centre at origin + ((i + 0.5) cell, (j + 0.5) cell).
struct ColumnGrid {
  float origin_x = 0, origin_y = 0;
  float cell = 1;  ///< m
  int columns = 0, rows = 0;

  [[nodiscard]] std::size_t cell_count() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
  }
};

/// A grid of cells of about `cell` over all particles with usable positions (finite, nearer than 1e9 m). Cells grow
/// where the particles are so far apart that there would be more than about a million.
[[nodiscard]] ColumnGrid make_column_grid(std::span<const Float4> position, float cell);

/// Height of the highest particle in each cell, -infinity where there is none.
void find_highest(const ColumnGrid& grid, std::span<const Float4> position, std::vector<float>& height);

/// The water's surface in cell (i, j): the highest particle, but no more than `allowance` above the median of the
/// highest of the 3 x 3 cells around, so that a flying drop does not count as surface; `fallback` where none of them
/// holds a particle.
[[nodiscard]] float surface_height(const ColumnGrid& grid, std::span<const float> height, int i, int j, float allowance,
                                   float fallback);

}  // namespace pelagos
