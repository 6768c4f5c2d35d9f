#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/particles.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

/// Axis-aligned region in local float coordinates, metres.
struct Region {
  float min[3] = {0, 0, 0};
  float max[3] = {0, 0, 0};
};

/// Uniform cells of one support radius over a region, and a stable counting sort into them. Cells run fastest along x,
/// so three neighbouring cells along x are one contiguous run of sorted points. Points outside the region count to the
/// nearest edge cell (their neighbours are still found there); a NaN coordinate counts to the first cell.
class CellGrid {
 public:
  CellGrid() = default;
  CellGrid(const Region& region, double cell_size);

  [[nodiscard]] int cells_x() const { return dims_[0]; }
  [[nodiscard]] int cells_y() const { return dims_[1]; }
  [[nodiscard]] int cells_z() const { return dims_[2]; }
  [[nodiscard]] std::size_t cell_count() const {
    return static_cast<std::size_t>(dims_[0]) * static_cast<std::size_t>(dims_[1]) * static_cast<std::size_t>(dims_[2]);
  }
  [[nodiscard]] std::uint32_t cell_of(const Float4& point) const;
  [[nodiscard]] std::size_t cell_index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(dims_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(dims_[0]) +
           static_cast<std::size_t>(x);
  }
  /// Centre of a cell, metres.
  [[nodiscard]] Float4 center(int x, int y, int z) const;

  /// Sorts points by cell, stably: `order[k]` is the old index of the k-th point, `begin()[c] .. begin()[c + 1]` are
  /// the points of cell c in the new order.
  /// @param chunks  parts of the points that threads count and place on their own; 0: as many as suit the threads.
  ///                Little is to be done for a chunk more where points are nearly sorted already.
  /// The result depends neither on the number of threads nor on that of chunks.
  void sort(TaskPool& pool, std::span<const Float4> points, std::vector<std::uint32_t>& order, std::size_t chunks = 0);

  [[nodiscard]] std::span<const std::uint32_t> begin() const { return begin_; }

  /// Notes which cells have points in one of the 27 cells around them, for sources that rarely change.
  void mark_near_cells();
  /// False only if mark_near_cells has been called since the last sort and found no point near.
  [[nodiscard]] bool may_be_near(std::size_t cell) const { return near_.empty() || near_[cell] != 0; }

 private:
  float origin_[3] = {0, 0, 0};
  float cell_size_ = 1.0F;
  float inverse_cell_size_ = 1.0F;
  int dims_[3] = {1, 1, 1};
  std::vector<std::uint32_t> begin_;      ///< [cells + 1]
  std::vector<std::uint8_t> near_;        ///< [cells], or empty: not marked
  std::vector<std::uint32_t> key_;        ///< [points] their cells, of the last sort
  std::vector<std::uint32_t> histogram_;  ///< [chunks][cells]
};

}  // namespace pelagos
