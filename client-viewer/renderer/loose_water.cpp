#include "renderer/loose_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace pelagos {
namespace {

constexpr double kFarthestCell = 1e6;    // of a place; farther ones share the last cell
constexpr std::uint64_t kCellBits = 21;  // of each axis in a key

/// Sets that are joined until they are whole (Tarjan 1975, with halved paths).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Eigen::Vector3f& place, double width) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(static_cast<double>(place[axis]) / width);
    const double bounded = std::isfinite(index) ? std::clamp(index, -kFarthestCell, kFarthestCell) : kFarthestCell;
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(bounded);
  }
  return cell;
}

std::uint64_t key_of(const Cell& cell) {
  std::uint64_t key = 0;
  for (const std::int64_t index : cell)
    key = key << kCellBits | static_cast<std::uint64_t>(index + (std::int64_t{1} << (kCellBits - 1)));
  return key;
}

/// A cell with particles: how many.
struct Occupied {
  Cell cell;
  std::uint64_t key;
  std::uint32_t count;
};

/// In the order of their keys.
std::vector<Occupied> occupied_cells(std::span<const SurfaceParticle> particles, double width) {
  std::vector<Occupied> cells;
  cells.reserve(particles.size());
  for (const SurfaceParticle& particle : particles) {
    const Cell cell = cell_of(particle.position, width);
    cells.push_back({cell, key_of(cell), 1});
  }
  std::sort(cells.begin(), cells.end(), [](const Occupied& a, const Occupied& b) { return a.key < b.key; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    if (cells[i].key == cells[last].key)
      ++cells[last].count;
    else
      cells[++last] = cells[i];
  }
  if (!cells.empty()) cells.resize(last + 1);
  return cells;
}

/// Number of the cell of that key; nothing where it is empty.
std::optional<std::uint32_t> find_cell(std::span<const Occupied> cells, std::uint64_t key) {
  const auto found = std::lower_bound(cells.begin(), cells.end(), key,
                                      [](const Occupied& one, std::uint64_t wanted) { return one.key < wanted; });
  if (found == cells.end() || found->key != key) return std::nullopt;
  return static_cast<std::uint32_t>(found - cells.begin());
}

/// Joins a cell with half the cells around it; the others join it in their turn.
void join_neighbors(std::span<const Occupied> cells, std::uint32_t i, Sets& sets) {
  const Cell cell = cells[i].cell;
  for (std::int64_t x = 0; x <= 1; ++x)
    for (std::int64_t y = x == 0 ? 0 : -1; y <= 1; ++y)
      for (std::int64_t z = x == 0 && y == 0 ? 1 : -1; z <= 1; ++z)
        if (const auto j = find_cell(cells, key_of({cell[0] + x, cell[1] + y, cell[2] + z}))) sets.join(i, *j);
}

}  // namespace

std::vector<std::uint8_t> find_loose_water(std::span<const SurfaceParticle> particles, double spacing) {
  const std::vector<Occupied> cells = occupied_cells(particles, spacing);
  const auto count = static_cast<std::uint32_t>(cells.size());
  Sets sets(count);
  for (std::uint32_t i = 0; i < count; ++i) join_neighbors(cells, i, sets);
  std::vector<std::uint32_t> size(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) size[sets.find(i)] += cells[i].count;
  const std::uint32_t largest = count > 0 ? *std::max_element(size.begin(), size.end()) : 0;
  const std::uint32_t least = std::min(kLeastBody, largest);
  std::vector<std::uint8_t> loose(particles.size(), 0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto cell = find_cell(cells, key_of(cell_of(particles[i].position, spacing)));
    loose[i] = size[sets.find(*cell)] < least ? 1 : 0;
  }
  return loose;
}

}  // namespace pelagos
