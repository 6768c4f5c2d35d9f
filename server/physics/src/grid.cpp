#include "physics/grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pelagos {

namespace {

/// The sort is cut into this many chunks of points, whatever the number of threads.
constexpr std::size_t kSortChunks = 2;
constexpr std::size_t kCellBlock = 8192;

int clamped_cell(float offset, int dims) {
  if (!(offset > 0.0F)) return 0;  // also catches NaN
  if (offset >= static_cast<float>(dims)) return dims - 1;
  return static_cast<int>(offset);
}

}  // namespace

CellGrid::CellGrid(const Region& region, double cell_size)
    : cell_size_(static_cast<float>(cell_size)), inverse_cell_size_(static_cast<float>(1.0 / cell_size)) {
  assert(cell_size > 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    origin_[axis] = region.min[axis];
    const double extent = static_cast<double>(region.max[axis]) - static_cast<double>(region.min[axis]);
    dims_[axis] = std::max(1, static_cast<int>(std::ceil(extent / cell_size)));
  }
  begin_.assign(cell_count() + 1, 0);
}

std::uint32_t CellGrid::cell_of(const Float4& point) const {
  const int x = clamped_cell((point.x - origin_[0]) * inverse_cell_size_, dims_[0]);
  const int y = clamped_cell((point.y - origin_[1]) * inverse_cell_size_, dims_[1]);
  const int z = clamped_cell((point.z - origin_[2]) * inverse_cell_size_, dims_[2]);
  return static_cast<std::uint32_t>(cell_index(x, y, z));
}

Float4 CellGrid::center(int x, int y, int z) const {
  return {origin_[0] + (static_cast<float>(x) + 0.5F) * cell_size_,
          origin_[1] + (static_cast<float>(y) + 0.5F) * cell_size_,
          origin_[2] + (static_cast<float>(z) + 0.5F) * cell_size_, 0.0F};
}

void CellGrid::mark_near_cells() {
  near_.assign(cell_count(), 0);
  const auto range = [](int at, int dims) { return std::pair{std::max(at - 1, 0), std::min(at + 1, dims - 1)}; };
  for (int z = 0; z < dims_[2]; ++z)
    for (int y = 0; y < dims_[1]; ++y)
      for (int x = 0; x < dims_[0]; ++x) {
        const std::size_t cell = cell_index(x, y, z);
        if (begin_[cell] == begin_[cell + 1]) continue;
        const auto [x0, x1] = range(x, dims_[0]);
        const auto [y0, y1] = range(y, dims_[1]);
        const auto [z0, z1] = range(z, dims_[2]);
        for (int k = z0; k <= z1; ++k)
          for (int j = y0; j <= y1; ++j)
            for (int i = x0; i <= x1; ++i) near_[cell_index(i, j, k)] = 1;
      }
}

void CellGrid::sort(TaskPool& pool, std::span<const Float4> points, std::vector<std::uint32_t>& order) {
  const std::size_t count = points.size(), cells = cell_count();
  const std::size_t chunk = (count + kSortChunks - 1) / kSortChunks;
  near_.clear();
  key_.resize(count);
  order.resize(count);
  histogram_.resize(kSortChunks * cells);

  const auto chunk_range = [&](std::size_t c) {
    return std::pair{std::min(c * chunk, count), std::min((c + 1) * chunk, count)};
  };
  pool.for_each_block(kSortChunks, [&](std::size_t c) {
    std::uint32_t* histogram = histogram_.data() + c * cells;
    std::fill_n(histogram, cells, 0U);
    const auto [first, last] = chunk_range(c);
    for (std::size_t i = first; i < last; ++i) {
      key_[i] = cell_of(points[i]);
      ++histogram[key_[i]];
    }
  });

  // Exclusive prefix sum over (cell, chunk), in blocks of cells: block totals first, then each block on its own.
  const std::size_t blocks = (cells + kCellBlock - 1) / kCellBlock;
  std::vector<std::uint32_t> total(blocks + 1, 0);
  pool.for_each_range(cells, kCellBlock, [&](std::size_t first, std::size_t last) {
    std::uint32_t sum = 0;
    for (std::size_t c = 0; c < kSortChunks; ++c)
      for (std::size_t cell = first; cell < last; ++cell) sum += histogram_[c * cells + cell];
    total[first / kCellBlock + 1] = sum;
  });
  for (std::size_t b = 0; b < blocks; ++b) total[b + 1] += total[b];
  pool.for_each_range(cells, kCellBlock, [&](std::size_t first, std::size_t last) {
    std::uint32_t running = total[first / kCellBlock];
    for (std::size_t cell = first; cell < last; ++cell) {
      begin_[cell] = running;
      for (std::size_t c = 0; c < kSortChunks; ++c) {
        const std::uint32_t in_chunk = histogram_[c * cells + cell];
        histogram_[c * cells + cell] = running;
        running += in_chunk;
      }
    }
  });
  begin_[cells] = static_cast<std::uint32_t>(count);

  pool.for_each_block(kSortChunks, [&](std::size_t c) {
    std::uint32_t* cursor = histogram_.data() + c * cells;
    const auto [first, last] = chunk_range(c);
    for (std::size_t i = first; i < last; ++i) order[cursor[key_[i]]++] = static_cast<std::uint32_t>(i);
  });
}

}  // namespace pelagos
