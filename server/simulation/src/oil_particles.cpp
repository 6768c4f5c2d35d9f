#include "simulation/oil_particles.hpp"

#include <algorithm>
#include <array>

namespace pelagos {

namespace {

bool is_oil(const ParticlePhases& particles, std::size_t i) {
  return particles.phase[i] == kOilPhase && vector_of(particles.position[i]).allFinite();
}

/// Column and row of a grid, the nearest for places outside.
std::array<int, 2> cell_of(const ColumnGrid& grid, const Float4& x) {
  return {std::clamp(static_cast<int>((x.x - grid.origin_x) / grid.cell), 0, grid.columns - 1),
          std::clamp(static_cast<int>((x.y - grid.origin_y) / grid.cell), 0, grid.rows - 1)};
}

std::array<int, 3> cell_at(const CellGrid& cells, const Eigen::Vector3f& place) {
  const auto index = static_cast<int>(cells.cell_of({place.x(), place.y(), place.z(), 0.0F}));
  const int nx = cells.cells_x(), ny = cells.cells_y();
  return {index % nx, index / nx % ny, index / (nx * ny)};
}

/// Calls body(begin, end) for each run of particles in the cells about a box, in the order of the particles.
template <class Body>
void for_each_run(const CellGrid& cells, const Eigen::AlignedBox3f& box, float margin, Body&& body) {
  const std::span<const std::uint32_t> begin = cells.begin();
  if (begin.empty()) return;  // never sorted: no particles
  const Eigen::Vector3f around = Eigen::Vector3f::Constant(margin);
  const std::array<int, 3> low = cell_at(cells, box.min() - around), high = cell_at(cells, box.max() + around);
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      body(begin[cells.cell_index(low[0], y, z)], begin[cells.cell_index(high[0], y, z) + 1]);
}

int count_around(const ColumnGrid& grid, std::span<const int> oil, const std::array<int, 2>& cell) {
  int around = 0;
  for (int v = std::max(cell[1] - 1, 0); v <= std::min(cell[1] + 1, grid.rows - 1); ++v)
    for (int u = std::max(cell[0] - 1, 0); u <= std::min(cell[0] + 1, grid.columns - 1); ++u)
      around += oil[grid.index(u, v)];
  return around;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> collect_water(const ParticlePhases& particles, const CellGrid& cells,
                                                      float moved, std::span<const Eigen::AlignedBox3f> boxes) {
  std::vector<std::vector<std::uint32_t>> found(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].isEmpty()) continue;
    for_each_run(cells, boxes[k], moved, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i)
        if (particles.phase[i] == kWaterPhase && boxes[k].contains(vector_of(particles.position[i])))
          found[k].push_back(i);
    });
  }
  return found;
}

std::optional<std::size_t> nearest_water(const ParticlePhases& particles, std::span<const std::uint32_t> among,
                                         const Eigen::Vector3f& place, float reach) {
  std::optional<std::size_t> found;
  float nearest = reach * reach;
  for (const std::uint32_t i : among) {
    if (particles.phase[i] != kWaterPhase) continue;
    const float distance = (vector_of(particles.position[i]) - place).squaredNorm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    found = i;
  }
  return found;
}

std::vector<int> count_oil(const ParticlePhases& particles, const ColumnGrid& grid) {
  std::vector<int> oil(grid.cell_count());
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    if (!is_oil(particles, i)) continue;
    const auto cell = cell_of(grid, particles.position[i]);
    ++oil[grid.index(cell[0], cell[1])];
  }
  return oil;
}

std::vector<std::size_t> find_thin_oil(const ParticlePhases& particles, const ColumnGrid& grid,
                                       std::span<const int> oil, int column, int vicinity) {
  std::vector<std::size_t> thin;
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    if (!is_oil(particles, i)) continue;
    const auto cell = cell_of(grid, particles.position[i]);
    if (oil[grid.index(cell[0], cell[1])] < column && count_around(grid, oil, cell) < vicinity) thin.push_back(i);
  }
  return thin;
}

}  // namespace pelagos
