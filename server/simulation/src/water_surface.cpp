#include "simulation/water_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pelagos {

namespace {

constexpr std::size_t kPlacesInBlock = 32;  // that one thread reads

}  // namespace

const WaterColumns& WaterSurface::columns(const FluidState& fluid) {
  if (!has_columns_) columns_.build(pool_, ColumnWater::of(fluid));
  has_columns_ = true;
  return columns_;
}

const SurfaceGrid& WaterSurface::grid(const FluidState& fluid) {
  if (!has_grid_) columns(fluid).sample(pool_, grid_);
  has_grid_ = true;
  return grid_;
}

const SurfaceGrid& WaterSurface::grid_with_velocities(const FluidState& fluid) {
  static_cast<void>(grid(fluid));
  if (!has_velocities_) columns(fluid).add_velocities(pool_, grid_);
  has_velocities_ = true;
  return grid_;
}

std::vector<SurfaceReading> WaterSurface::read_particles(const FluidState& fluid,
                                                         std::span<const SurfacePlace> places) {
  std::vector<SurfaceReading> readings;
  readings.reserve(places.size());
  for (const SurfacePlace& place : places) readings.push_back(columns(fluid).read(place));
  return readings;
}

std::vector<SurfaceReading> WaterSurface::read_shared(const FluidState& fluid, std::span<const SurfacePlace> places) {
  std::vector<SurfaceReading> readings(places.size());
  std::vector<std::size_t> shared;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (particle_share(around_, places[k].local) > 0.0) shared.push_back(k);
  if (shared.empty()) return readings;
  const WaterColumns& water = columns(fluid);
  pool_.for_each_range(shared.size(), kPlacesInBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) readings[shared[i]] = water.read(places[shared[i]]);
  });
  return readings;
}

std::vector<SurfaceReading> WaterSurface::read(const FluidState& fluid, const WaveField& sea, double time,
                                               std::span<const SurfacePlace> places) {
  std::vector<SurfaceReading> readings = read_shared(fluid, places);
  mix_with_waves(around_, sea, time, places, readings);
  return readings;
}

std::optional<GridSample> sample_at(const SurfaceGrid& surface, const Eigen::Vector2d& local) {
  const ColumnGrid& grid = surface.grid;
  if (surface.cells.empty() || !local.allFinite()) return std::nullopt;
  const double gx = (local.x() - static_cast<double>(grid.origin_x)) / static_cast<double>(grid.cell) - 0.5;
  const double gy = (local.y() - static_cast<double>(grid.origin_y)) / static_cast<double>(grid.cell) - 0.5;
  if (gx < -1.5 || gy < -1.5 || gx > grid.columns + 0.5 || gy > grid.rows + 0.5) return std::nullopt;
  const int i = static_cast<int>(std::floor(gx)), j = static_cast<int>(std::floor(gy));
  const double u = gx - i, v = gy - j;
  const std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  GridSample sample;
  double total = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int a = std::clamp(i + corner % 2, 0, grid.columns - 1), b = std::clamp(j + corner / 2, 0, grid.rows - 1);
    const SurfaceCell& cell = surface.cells[grid.index(a, b)];
    if (!cell.wet) continue;
    const double weight = std::max(weights[static_cast<std::size_t>(corner)], 1e-9);
    sample.height += weight * static_cast<double>(cell.height);
    sample.velocity += weight * cell.velocity.cast<double>();
    total += weight;
  }
  if (total == 0.0) return std::nullopt;
  sample.height /= total;
  sample.velocity /= total;
  return sample;
}

Eigen::Vector3d mean_velocity(const SurfaceGrid& surface) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const SurfaceCell& cell : surface.cells) {
    if (!cell.wet) continue;
    sum += cell.velocity.cast<double>();
    ++count;
  }
  return count > 0 ? Eigen::Vector3d(sum / count) : sum;
}

}  // namespace pelagos
