#include "simulation/surface_blend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pelagos {

namespace {

/// m: places this far apart share an anchor. At half of it a float has steps of 0.5 mm.
constexpr double kTile = 8192.0;

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

Eigen::Vector2d lower_corner(const Region& patch) { return {patch.min[0], patch.min[1]}; }
Eigen::Vector2d upper_corner(const Region& patch) { return {patch.max[0], patch.max[1]}; }

/// A place and the tile that it lies in, counted from that of the patch's middle.
struct TiledPlace {
  std::pair<double, double> tile;
  std::size_t index = 0;
};

std::vector<TiledPlace> sort_by_tile(const SurfaceSurroundings& around, std::span<const SurfacePlace> places) {
  const Eigen::Vector2d middle = 0.5 * (lower_corner(around.patch) + upper_corner(around.patch));
  std::vector<TiledPlace> sorted(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Eigen::Vector2d tile = ((places[k].local - middle) / kTile).array().round();
    sorted[k] = {{tile.x(), tile.y()}, k};
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const TiledPlace& a, const TiledPlace& b) { return a.tile < b.tile; });
  return sorted;
}

/// The waves at the places of one tile.
void read_tile(const SurfaceSurroundings& around, const WaveMoment& moment, std::span<const TiledPlace> tile,
               std::span<const SurfacePlace> places, std::span<SurfaceReading> readings) {
  std::array<std::vector<float>, 8> column;
  for (std::vector<float>& values : column) values.resize(tile.size());
  auto& [x, y, height, slope_x, slope_y, u, v, w] = column;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Eigen::Vector2f at = (around.frame.to_world(places[tile[i].index].local) - moment.anchor).cast<float>();
    x[i] = at.x();
    y[i] = at.y();
  }
  evaluate_displaced_surface(moment, x, y, {height, slope_x, slope_y, u, v, w});
  const double level = around.frame.local_height(moment.level);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const SurfacePlace& place = places[tile[i].index];
    SurfaceReading& reading = readings[tile[i].index];
    reading.wet = true;
    reading.share = 0.0;
    reading.height = level + static_cast<double>(height[i]);
    reading.normal = normal_of(Eigen::Vector2f(slope_x[i], slope_y[i]).cast<double>());
    Eigen::Vector3f velocity(u[i], v[i], w[i]);
    if (place.height && *place.height < reading.height)
      velocity =
          motion_at(moment, {x[i], y[i], static_cast<float>(*place.height - level)}, Stretching::kWheeler).velocity;
    reading.velocity = velocity.cast<double>();
  }
}

}  // namespace

double particle_share(const SurfaceSurroundings& around, const Eigen::Vector2d& local) {
  if (!local.allFinite()) return 0.0;
  return patch_weight(around.blend, lower_corner(around.patch), upper_corner(around.patch), local);
}

void read_waves(const SurfaceSurroundings& around, const WaveField& sea, double time,
                std::span<const SurfacePlace> places, std::span<SurfaceReading> readings) {
  const Eigen::Vector2d middle =
      around.frame.to_world(Eigen::Vector2d(0.5 * (lower_corner(around.patch) + upper_corner(around.patch))));
  const std::vector<TiledPlace> sorted = sort_by_tile(around, places);
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    const auto& tile = sorted[begin].tile;
    while (end < sorted.size() && sorted[end].tile == tile) ++end;
    const WaveMoment moment = sea.at(time, middle + kTile * Eigen::Vector2d(tile.first, tile.second));
    read_tile(around, moment, std::span(sorted).subspan(begin, end - begin), places, readings);
  }
}

void mix_with_waves(const SurfaceSurroundings& around, const WaveField& sea, double time,
                    std::span<const SurfacePlace> places, std::span<SurfaceReading> readings) {
  std::vector<SurfacePlace> shared;
  std::vector<std::size_t> index;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!places[k].local.allFinite() || particle_share(around, places[k].local) == 1.0) continue;
    shared.push_back(places[k]);
    index.push_back(k);
  }
  std::vector<SurfaceReading> waves(shared.size());
  read_waves(around, sea, time, shared, waves);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    SurfaceReading& reading = readings[index[i]];
    const double share = particle_share(around, shared[i].local);
    reading = reading.wet && share > 0.0 ? blend(reading, waves[i], share) : waves[i];
  }
}

Eigen::Vector3d missing_current(const SurfaceReading& reading, const Current& current, const Eigen::Vector3d& position,
                                double time) {
  return reading.share * current.unresolved_velocity_at(position, time) +
         (1.0 - reading.share) * current.velocity_at(position, time);
}

}  // namespace pelagos
