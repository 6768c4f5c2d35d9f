#include "simulation/edge_watch.hpp"

#include <cmath>
#include <vector>

namespace pelagos {

namespace {

constexpr double kZoneMemory = 5.0, kHeightMemory = 60.0;  ///< s
constexpr double kLeastSeconds = 5.0;                      ///< of heights, for a ratio
constexpr int kPlaces = 8;                                 ///< along each side, of heights
/// Waves lower than this, in spacings and by their rms at the places, give no ratio.
constexpr double kFlat = 0.05;

/// A local coordinate of place k of kPlaces between the zones.
float place_between(const OpenSeaShape& shape, std::size_t axis, int k) {
  const double rim = shape.open[axis] ? kRimColumns * shape.spacing + shape.zone : 0.0;
  const double low = static_cast<double>(shape.patch.min[axis]) + rim,
               high = static_cast<double>(shape.patch.max[axis]) - rim;
  return static_cast<float>(low + (high - low) * (k + 0.5) / kPlaces);
}

}  // namespace

void EdgeWatch::count(const Renewal& renewal) {
  created_ += renewal.created;
  deleted_ += renewal.deleted;
}

void EdgeWatch::add_zones(const ZoneMismatch& mismatch, double dt) {
  const double keep = std::exp(-dt / kZoneMemory);
  mismatch_ = keep * mismatch_ + mismatch.squares;
  mismatch_weight_ = keep * mismatch_weight_ + mismatch.count;
}

void EdgeWatch::add_heights(const OpenSeaShape& shape, const SurfaceGrid& surface, const WaveMoment& moment,
                            double seconds, const std::function<bool(const Eigen::Vector3d&)>& hidden) {
  std::vector<float> x, y;
  for (int i = 0; i < kPlaces; ++i)
    for (int j = 0; j < kPlaces; ++j) {
      x.push_back(place_between(shape, 0, i));
      y.push_back(place_between(shape, 1, j));
    }
  std::vector<float> height(x.size()), a(x.size()), b(x.size()), u(x.size()), v(x.size()), w(x.size());
  evaluate_displaced_surface(moment, x, y, {height, a, b, u, v, w});
  const double keep = std::exp(-seconds / kHeightMemory);
  product_ *= keep;
  square_ *= keep;
  seconds_ += seconds;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Eigen::Vector2d place(static_cast<double>(x[k]), static_cast<double>(y[k]));
    const auto waves = static_cast<double>(height[k]);
    const auto water = sample_at(surface, place);
    if (!water || hidden({place.x(), place.y(), shape.level + waves})) continue;
    product_ += (water->height - shape.level) * waves;
    square_ += waves * waves;
  }
}

EdgeQuality EdgeWatch::quality(const OpenSeaShape& shape, std::size_t free, std::size_t wanted,
                               const WaveMoment& moment) const {
  EdgeQuality quality;
  double area = 1.0, variance = 0.0;
  for (std::size_t axis = 0; axis < 2; ++axis)
    area *= static_cast<double>(shape.patch.max[axis] - shape.patch.min[axis]) -
            (shape.open[axis] ? 2.0 * kRimColumns * shape.spacing : 0.0);
  quality.level = (static_cast<double>(free) - static_cast<double>(wanted)) * std::pow(shape.spacing, 3) / area;
  for (const MomentWave& wave : moment.waves) variance += 0.5 * std::pow(static_cast<double>(wave.amplitude), 2);
  quality.significant_height = 4.0 * std::sqrt(variance);
  if (seconds_ >= kLeastSeconds && square_ > std::pow(kFlat * shape.spacing * kPlaces, 2))
    quality.height_ratio = product_ / square_;
  if (mismatch_weight_ > 0.0) quality.mismatch = std::sqrt(mismatch_ / mismatch_weight_);
  quality.created = created_;
  quality.deleted = deleted_;
  return quality;
}

}  // namespace pelagos
