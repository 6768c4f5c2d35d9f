#include "cell_sort.hpp"

#include <algorithm>
#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cell_sort.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "physics/simd_records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

/// min(max(trunc(x), 0), dims - 1) of x = (value - origin) / cell size; 0 for NaN.
HWY_INLINE IntV cells_along(FloatV value, float origin, float inverse_cell_size, int dims) {
  const FloatTag d;
  const FloatV offset = hn::Mul(hn::Sub(value, hn::Set(d, origin)), hn::Set(d, inverse_cell_size));
  const FloatV inside = hn::IfThenElseZero(hn::Gt(offset, hn::Zero(d)), offset);
  return hn::ConvertTo(IntTag(), hn::Min(inside, hn::Set(d, static_cast<float>(dims - 1))));
}

HWY_INLINE IntV cells_of(const CellFrame& frame, const Vec4& p) {
  const IntTag di;
  const IntV x = cells_along(p.x, frame.origin[0], frame.inverse_cell_size, frame.dims[0]);
  const IntV y = cells_along(p.y, frame.origin[1], frame.inverse_cell_size, frame.dims[1]);
  const IntV z = cells_along(p.z, frame.origin[2], frame.inverse_cell_size, frame.dims[2]);
  const IntV row = hn::Add(hn::Mul(z, hn::Set(di, frame.dims[1])), y);
  return hn::Add(hn::Mul(row, hn::Set(di, frame.dims[0])), x);
}

/// Writes the cells of `count` points; returns their range. Cells have numbers below 2^31.
CellRange find_cells_impl(const CellFrame& frame, const Float4* points, std::size_t count, std::uint32_t* key) {
  const IntTag di;
  const std::size_t lanes = hn::Lanes(di);
  IntV lowest = hn::Set(di, std::numeric_limits<std::int32_t>::max()), highest = hn::Set(di, -1);
  const auto find = [&](const Float4* from, std::int32_t* to) HWY_ATTR {
    const IntV cells = cells_of(frame, load_records(from));
    lowest = hn::Min(lowest, cells);
    highest = hn::Max(highest, cells);
    hn::StoreU(cells, di, to);
  };
  auto* out = reinterpret_cast<std::int32_t*>(key);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) find(points + i, out + i);
  if (i < count) {  // the last ones, filled up with one of them
    std::array<Float4, kLanes> last;
    std::array<std::int32_t, kLanes> cells;
    last.fill(points[i]);
    std::copy(points + i, points + count, last.begin());
    find(last.data(), cells.data());
    std::copy_n(cells.begin(), count - i, out + i);
  }
  if (count == 0) return {};
  return {static_cast<std::size_t>(hn::GetLane(hn::MinOfLanes(di, lowest))),
          static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(di, highest))) + 1};
}

// Plain loops: the compiler vectorises them for each instruction set.

HWY_INLINE CellRange overlap(const CellRange& a, const CellRange& b) {
  const std::size_t first = a.first > b.first ? a.first : b.first, last = a.last < b.last ? a.last : b.last;
  return {first, last > first ? last : first};
}

std::uint32_t add_histograms_impl(const SortChunk* chunks, std::size_t chunk_count, const CellRange& block,
                                  std::uint32_t* HWY_RESTRICT count) {
  for (std::size_t cell = block.first; cell < block.last; ++cell) count[cell] = 0;
  for (std::size_t c = 0; c < chunk_count; ++c) {
    const CellRange both = overlap(chunks[c].cells, block);
    const std::uint32_t* HWY_RESTRICT histogram = chunks[c].histogram;
    for (std::size_t cell = both.first; cell < both.last; ++cell) count[cell] += histogram[cell];
  }
  std::uint32_t sum = 0;
  for (std::size_t cell = block.first; cell < block.last; ++cell) sum += count[cell];
  return sum;
}

void place_cells_impl(const SortChunk* chunks, std::size_t chunk_count, const CellRange& block,
                      std::uint32_t begin_of_block, std::uint32_t* HWY_RESTRICT begin) {
  alignas(64) std::uint32_t next[kCellBlock];
  std::uint32_t running = begin_of_block;
  for (std::size_t cell = block.first; cell < block.last; ++cell) {
    const std::uint32_t count = begin[cell];
    begin[cell] = next[cell - block.first] = running;
    running += count;
  }
  for (std::size_t c = 0; c < chunk_count; ++c) {
    const CellRange both = overlap(chunks[c].cells, block);
    std::uint32_t* HWY_RESTRICT histogram = chunks[c].histogram + both.first;
    std::uint32_t* HWY_RESTRICT place = next + (both.first - block.first);
    for (std::size_t k = 0; k < both.last - both.first; ++k) {
      const std::uint32_t count = histogram[k];
      histogram[k] = place[k];
      place[k] += count;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(find_cells_impl);
HWY_EXPORT(add_histograms_impl);
HWY_EXPORT(place_cells_impl);

void find_cells(const CellFrame& frame, std::span<const Float4> points, SortChunk& chunk,
                std::span<std::uint32_t> key) {
  chunk.cells = HWY_DYNAMIC_DISPATCH(find_cells_impl)(frame, points.data() + chunk.first, chunk.last - chunk.first,
                                                      key.data() + chunk.first);
}

void count_points(std::span<const std::uint32_t> key, const SortChunk& chunk) {
  std::fill(chunk.histogram + chunk.cells.first, chunk.histogram + chunk.cells.last, 0U);
  for (const std::uint32_t cell : key.subspan(chunk.first, chunk.last - chunk.first)) ++chunk.histogram[cell];
}

std::uint32_t add_histograms(std::span<const SortChunk> chunks, const CellRange& block,
                             std::span<std::uint32_t> count) {
  return HWY_DYNAMIC_DISPATCH(add_histograms_impl)(chunks.data(), chunks.size(), block, count.data());
}

void place_cells(std::span<const SortChunk> chunks, const CellRange& block, std::uint32_t begin_of_block,
                 std::span<std::uint32_t> begin) {
  HWY_DYNAMIC_DISPATCH(place_cells_impl)(chunks.data(), chunks.size(), block, begin_of_block, begin.data());
}

void write_order(std::span<const std::uint32_t> key, const SortChunk& chunk, std::span<std::uint32_t> order) {
  for (std::size_t i = chunk.first; i < chunk.last; ++i)
    order[chunk.histogram[key[i]]++] = static_cast<std::uint32_t>(i);
}

}  // namespace pelagos
#endif  // HWY_ONCE
