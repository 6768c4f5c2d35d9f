#include "physics/grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "cell_sort.hpp"

namespace pelagos {

namespace {

/// A chunk has at least so many points: fewer are not worth handing to a thread.
constexpr std::size_t kLeastChunk = 2048;
/// Chunks for each thread: one that is held up by other programs leaves its second chunk to the others.
constexpr std::size_t kChunksPerThread = 2;

int clamped_cell(float offset, int dims) {
  if (!(offset > 0.0F)) return 0;  // also catches NaN
  if (offset >= static_cast<float>(dims)) return dims - 1;
  return static_cast<int>(offset);
}

std::vector<SortChunk> make_chunks(std::size_t points, std::size_t chunks, std::size_t cells,
                                   std::vector<std::uint32_t>& histograms) {
  histograms.resize(chunks * cells);
  const std::size_t size = (points + chunks - 1) / chunks;
  std::vector<SortChunk> all(chunks);
  for (std::size_t c = 0; c < chunks; ++c)
    all[c] = {std::min(c * size, points), std::min((c + 1) * size, points), {}, histograms.data() + c * cells};
  return all;
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

void CellGrid::sort(TaskPool& pool, std::span<const Float4> points, std::vector<std::uint32_t>& order,
                    std::size_t chunks) {
  const std::size_t count = points.size(), cells = cell_count();
  if (chunks == 0)
    chunks = std::clamp(count / kLeastChunk, std::size_t{1},
                        kChunksPerThread * static_cast<std::size_t>(pool.thread_count()));
  near_.clear();
  key_.resize(count);
  order.resize(count);
  std::vector<SortChunk> all = make_chunks(count, chunks, cells, histogram_);
  const CellFrame frame{{origin_[0], origin_[1], origin_[2]}, inverse_cell_size_, {dims_[0], dims_[1], dims_[2]}};
  pool.for_each_block(chunks, [&](std::size_t c) {
    find_cells(frame, points, all[c], key_);
    count_points(key_, all[c]);
  });
  // Exclusive prefix sum over (cell, chunk), in blocks of cells: block totals first, then each block on its own.
  std::vector<std::uint32_t> total((cells + kCellBlock - 1) / kCellBlock + 1, 0);
  pool.for_each_range(cells, kCellBlock, [&](std::size_t first, std::size_t last) {
    total[first / kCellBlock + 1] = add_histograms(all, {first, last}, begin_);
  });
  std::partial_sum(total.begin(), total.end(), total.begin());
  pool.for_each_range(cells, kCellBlock, [&](std::size_t first, std::size_t last) {
    place_cells(all, {first, last}, total[first / kCellBlock], begin_);
  });
  begin_[cells] = static_cast<std::uint32_t>(count);
  pool.for_each_block(chunks, [&](std::size_t c) { write_order(key_, all[c], order); });
}

}  // namespace pelagos
