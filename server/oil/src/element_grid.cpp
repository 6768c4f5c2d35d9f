#include "element_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "film.hpp"

namespace pelagos {

std::int32_t ElementGrid::cell_of(double coordinate) const {
  constexpr double kFarthestCell = 1e9;
  return static_cast<std::int32_t>(std::floor(std::clamp(coordinate * inverse_cell_, -kFarthestCell, kFarthestCell)));
}

std::uint32_t ElementGrid::bucket_of(std::int32_t cell_x, std::int32_t cell_y) const {
  // Rows of cells lie side by side in blocks of eight, so that neighbours share cache lines.
  const auto x = static_cast<std::uint32_t>(cell_x), y = static_cast<std::uint32_t>(cell_y);
  const std::uint32_t block = (x >> 3) * 0x9E3779B1u ^ (y >> 3) * 0x85EBCA77u;
  return ((block << 6) ^ (block >> 7) ^ ((y & 7u) << 3 | (x & 7u))) & mask_;
}

void ElementGrid::build(std::span<const SlickElement> elements) {
  const std::size_t count = elements.size();
  double total = 0.0;
  for (const SlickElement& e : elements) total += e.size;
  const double cell = count > 0 ? kReachPerSize * total / static_cast<double>(count) : 1.0;
  inverse_cell_ = 1.0 / std::max(cell, 1e-3);
  mask_ = std::bit_ceil(std::max<std::uint32_t>(64, 2 * static_cast<std::uint32_t>(count))) - 1;

  start_.assign(mask_ + 2, 0);
  unsorted_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SlickElement& e = elements[i];
    unsorted_[i] = {e.position.x(),          e.position.y(),          e.size,
                    cell_of(e.position.x()), cell_of(e.position.y()), static_cast<std::uint32_t>(i)};
    ++start_[bucket_of(unsorted_[i].cell_x, unsorted_[i].cell_y) + 1];
  }
  for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
  entries_.resize(count);
  next_.assign(start_.begin(), start_.end() - 1);
  for (const Entry& entry : unsorted_) entries_[next_[bucket_of(entry.cell_x, entry.cell_y)]++] = entry;
}

}  // namespace pelagos
