#include "simulation/water_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace pelagos {

namespace {

Eigen::Vector2d slope_of(const SurfaceReading& reading) { return -reading.normal.head<2>() / reading.normal.z(); }

Eigen::Vector3d normal_of(const Eigen::Vector2d& slope) {
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
}

/// The share w of the particles' surface and 1 - w of the wave field's.
SurfaceReading blend(const SurfaceReading& water, const SurfaceReading& waves, double w) {
  SurfaceReading mixed;
  mixed.wet = true;
  mixed.share = w;
  mixed.height = w * water.height + (1.0 - w) * waves.height;
  mixed.normal = normal_of(w * slope_of(water) + (1.0 - w) * slope_of(waves));
  mixed.velocity = w * water.velocity + (1.0 - w) * waves.velocity;
  return mixed;
}

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

SurfaceReading WaterSurface::read_waves(const WaveMoment& moment, const SurfacePlace& place) const {
  const Eigen::Vector2f at = (around_.frame.to_world(place.local) - moment.anchor).cast<float>();
  float height = 0, slope_x = 0, slope_y = 0;
  Eigen::Vector3f velocity;
  evaluate_displaced_surface(
      moment, {&at.x(), 1}, {&at.y(), 1},
      {{&height, 1}, {&slope_x, 1}, {&slope_y, 1}, {&velocity.x(), 1}, {&velocity.y(), 1}, {&velocity.z(), 1}});
  const double level = around_.frame.local_height(moment.level);
  SurfaceReading reading;
  reading.wet = true;
  reading.share = 0.0;
  reading.height = level + static_cast<double>(height);
  reading.normal = normal_of(Eigen::Vector2f(slope_x, slope_y).cast<double>());
  if (place.height && *place.height < reading.height)
    velocity =
        motion_at(moment, {at.x(), at.y(), static_cast<float>(*place.height - level)}, Stretching::kWheeler).velocity;
  reading.velocity = velocity.cast<double>();
  return reading;
}

std::vector<SurfaceReading> WaterSurface::read_particles(const FluidState& fluid,
                                                         std::span<const SurfacePlace> places) {
  std::vector<SurfaceReading> readings;
  readings.reserve(places.size());
  for (const SurfacePlace& place : places) readings.push_back(columns(fluid).read(place));
  return readings;
}

std::vector<SurfaceReading> WaterSurface::read(const FluidState& fluid, const WaveField& sea, double time,
                                               std::span<const SurfacePlace> places) {
  const Eigen::Vector2d min(around_.patch.min[0], around_.patch.min[1]),
      max(around_.patch.max[0], around_.patch.max[1]);
  std::optional<WaveMoment> moment;
  std::vector<SurfaceReading> readings;
  readings.reserve(places.size());
  for (const SurfacePlace& place : places) {
    SurfaceReading& reading = readings.emplace_back();
    if (!place.local.allFinite()) continue;
    const double share = patch_weight(around_.blend, min, max, place.local);
    if (share > 0.0) reading = columns(fluid).read(place);
    if (share == 1.0) continue;
    if (!moment) moment = sea.at(time, around_.frame.to_world(Eigen::Vector2d(0.5 * (min + max))));
    const SurfaceReading waves = read_waves(*moment, place);
    reading = reading.wet && share > 0.0 ? blend(reading, waves, share) : waves;
  }
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
