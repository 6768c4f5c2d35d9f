#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pelagos {

/// A horizontal grid over the particles, local coordinates; cell (i, j) has its centre at
/// origin + ((i + 0.5) cell, (j + 0.5) cell).
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
  friend bool operator==(const ColumnGrid&, const ColumnGrid&) = default;
};

/// The water's surface at the centre of a cell.
struct SurfaceCell {
  float height = 0;                                    ///< m, local
  bool wet = false;                                    ///< false: no water there, and the rest means nothing
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();  ///< m/s, of the water there; zero where nobody asks for it
};

/// The surface of the particles' water at one instant, cell by cell (see WaterColumns). Between centres it is linear.
struct SurfaceGrid {
  ColumnGrid grid;
  std::vector<SurfaceCell> cells;
};

}  // namespace pelagos
