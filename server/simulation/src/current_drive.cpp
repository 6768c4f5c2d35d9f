#include "simulation/current_drive.hpp"

#include <algorithm>
#include <cmath>

#include "values/lattice.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kLayerRows = 2;    ///< one row jumps between layers with every wave, two hold their mean
constexpr std::size_t kMostLayers = 64;  ///< deeper water gets thicker layers
/// A layer with this share of its particles counts as full. Rest is 1 within 1 % (compression, settling); the layer at
/// the crests' feet loses whole columns.
constexpr double kFull = 0.95;

constexpr double kRounding = 1e-9;  ///< rows: a level in the middle of one counts as in it

}  // namespace

/// Particles of a full row: as many as fit the patch; with bodies in it, the mean.
double CurrentDrive::full_row(const Scene& scene, std::size_t particles) const {
  const auto patch = lattice_counts(scene.patch, spacing_, water_edges(scene));
  const auto row = static_cast<double>(patch[0] * patch[1]);
  return scene.bodies.empty() ? row : std::min(row, static_cast<double>(particles) / static_cast<double>(rows_));
}

CurrentDrive::CurrentDrive(const Scene& scene, const PatchFrame& frame, double water_level, std::size_t particles)
    : spacing_(scene.particle_spacing) {
  for (std::size_t axis = 0; axis < 2; ++axis) moves_[axis] = scene.patch_edges[axis] == PatchEdge::kPeriodic;
  // Rows stand at d/2, 3d/2, ... above `floor_`, so no row lies on the edge of a layer.
  floor_ = frame.local_height(scene.patch.min.z()) + (lattice_offset(water_edges(scene)[2]) - 0.5) * spacing_;
  depth_ = frame.local_height(water_level) - floor_;
  rows_ = static_cast<std::size_t>(std::max(1.0, std::round(depth_ / spacing_ + kRounding)));
  layer_rows_ = std::max(kLayerRows, (rows_ + kMostLayers - 1) / kMostLayers);
  full_ = full_row(scene, particles) * static_cast<double>(layer_rows_);
  layer_.resize((rows_ + layer_rows_ - 1) / layer_rows_);
  acceleration_.resize(layer_.size());
}

CurrentLayers CurrentDrive::layers() const {
  return {floor_, spacing_ * static_cast<double>(layer_rows_), layer_.size()};
}

void CurrentDrive::start(TaskPool& pool, const Current& current, double time, std::span<const Float4> position,
                         std::size_t count, std::span<Float4> velocity) const {
  add_profile(pool, current.settings_at(time), floor_ + depth_, moves_, position.first(count), velocity.first(count));
}

/// The lowest of the layers that share a mean: the highest full one under the surface's own.
std::size_t CurrentDrive::first_shared_layer() const {
  std::size_t layer = layer_.size() - 1;
  if (layer > 0) --layer;  // the uppermost holds the crests as well, so its count says nothing
  while (layer > 0 && layer_[layer].count < kFull * full_) --layer;
  return layer;
}

double CurrentDrive::mean_profile(const CurrentSettings& current, std::size_t layer) const {
  const std::size_t begin = layer * layer_rows_, end = std::min(begin + layer_rows_, rows_);
  double sum = 0.0;
  for (std::size_t row = begin; row < end; ++row)
    sum += current.profile(depth_ - (static_cast<double>(row) + 0.5) * spacing_);
  return sum / static_cast<double>(end - begin);
}

void CurrentDrive::choose_accelerations(const Current& current, double time) {
  const CurrentSettings& target = current.target();
  const Eigen::Vector3d surface = current.surface_velocity_at(time), rate = current.surface_rate_at(time);
  const std::size_t shared = first_shared_layer();
  Vector2 lack_of_shared{0.0, 0.0};
  double count_of_shared = 0.0;
  for (std::size_t k = 0; k < layer_.size(); ++k) {
    const double part = mean_profile(target, k);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      const double lack = layer_[k].count * part * surface[a] - layer_[k].velocity[axis];
      acceleration_[k][axis] = part * rate[a];
      if (k >= shared) lack_of_shared[axis] += lack;
      if (k < shared && layer_[k].count > 0.0) acceleration_[k][axis] += lack / (layer_[k].count * target.relaxation);
    }
    if (k >= shared) count_of_shared += layer_[k].count;
  }
  if (count_of_shared == 0.0) return;
  for (std::size_t k = shared; k < layer_.size(); ++k)
    for (std::size_t axis = 0; axis < 2; ++axis)
      acceleration_[k][axis] += lack_of_shared[axis] / (count_of_shared * target.relaxation);
}

void CurrentDrive::add_acceleration(TaskPool& pool, const Current& current, double time,
                                    std::span<const Float4> position, std::span<const Float4> velocity,
                                    std::size_t count, std::span<Float4> acceleration) {
  sum_layers(pool, layers(), position.first(count), velocity.first(count), partial_, layer_);
  choose_accelerations(current, time);
  add_between_layers(pool, layers(), acceleration_, moves_, position.first(count), acceleration.first(count));
}

}  // namespace pelagos
