#pragma once

#include <array>
#include <cstddef>

namespace pelagos {

/// Particles that may belong to a column: three rows of neighbouring bins, each without gaps. m, local.
struct ColumnRow {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  std::size_t count = 0;
};
using ColumnRows = std::array<ColumnRow, 3>;

/// The column: its axis and its soft sides, weight (1 - r^2 / R^2)^2 on r < R.
struct ColumnAxis {
  float x = 0, y = 0;
  float radius = 1;   ///< m, R
  float spacing = 1;  ///< m, d
};

/// z of the highest particle in the column that is lower than `below`; -infinity where there is none.
[[nodiscard]] float highest_below(const ColumnRows& rows, const ColumnAxis& axis, float below);

/// What a column holds about its top, in particles times their weight.
struct ColumnSums {
  float under_top = 0;  ///< within 2 d below the top particle, itself included
  float counted = 0, counted_way_x = 0,
        counted_way_y = 0;                         ///< between `level` and 2 d above the top; its first moments, m
  float slab = 0, slab_way_x = 0, slab_way_y = 0;  ///< between 2 d below `level` and `level`
  bool deep = false;                               ///< whether a particle lies 1.5 d below `level`, or lower
};
/// @param top    m, z of the top particle; level = top - 2 d. A particle counts as a slice of thickness d.
[[nodiscard]] ColumnSums sum_column(const ColumnRows& rows, const ColumnAxis& axis, float top);

}  // namespace pelagos
