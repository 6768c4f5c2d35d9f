#include "sample_images.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "coordinate.hpp"

namespace pelagos {

namespace {

constexpr float kSamePlace = 0.4F;  ///< spacings; two samples of a layer are twice as far apart

/// Places by cells of `size`, to ask whether one is near another.
class PlaceIndex {
 public:
  explicit PlaceIndex(float size) : size_(size) {}

  void add(const Float4& p) { places_[key(cell(p.x), cell(p.y), cell(p.z))].push_back(p); }
  [[nodiscard]] bool has_near(const Float4& p) const {
    for (std::int64_t z = cell(p.z) - 1; z <= cell(p.z) + 1; ++z)
      for (std::int64_t y = cell(p.y) - 1; y <= cell(p.y) + 1; ++y)
        for (std::int64_t x = cell(p.x) - 1; x <= cell(p.x) + 1; ++x)
          if (const auto found = places_.find(key(x, y, z)); found != places_.end() && any_near(found->second, p))
            return true;
    return false;
  }

 private:
  [[nodiscard]] std::int64_t cell(float x) const { return static_cast<std::int64_t>(std::floor(x / size_)); }
  static std::int64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::int64_t kSide = 1 << 20;
    return (z * kSide + y) * kSide + x;
  }
  [[nodiscard]] bool any_near(const std::vector<Float4>& places, const Float4& p) const {
    return std::any_of(places.begin(), places.end(), [&](const Float4& q) {
      const float x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
      return x * x + y * y + z * z < size_ * size_;
    });
  }

  float size_;
  std::unordered_map<std::int64_t, std::vector<Float4>> places_;
};

/// The image of a sample in the plane across `axis` at `place`.
PlacedSample reflected(PlacedSample sample, std::size_t axis, float place) {
  float& x = coordinate(sample.position, axis);
  x = 2.0F * place - x;
  coordinate(sample.sign, axis) *= -1.0F;
  return sample;
}
PlacedSample shifted(PlacedSample sample, std::size_t axis, float by) {
  coordinate(sample.position, axis) += by;
  return sample;
}

void mirror_across(std::size_t axis, const Region& patch, float reach, float spacing,
                   std::vector<PlacedSample>& samples) {
  PlaceIndex taken(kSamePlace * spacing);
  std::vector<PlacedSample> images;
  for (const float face : {patch.min[axis], patch.max[axis]}) {
    const bool upper = face == patch.max[axis];
    for (const PlacedSample& sample : samples) {
      const float inside = (upper ? -1.0F : 1.0F) * (coordinate(sample.position, axis) - face);
      if (!(std::abs(inside) < reach)) continue;
      taken.add(sample.position);
      if (inside >= 0.0F) images.push_back(reflected(sample, axis, face));
    }
  }
  for (const PlacedSample& image : images)
    if (!taken.has_near(image.position)) samples.push_back(image);
}

void repeat_across(std::size_t axis, const Region& patch, float reach, std::vector<PlacedSample>& samples) {
  const float low = patch.min[axis], high = patch.max[axis];
  const std::size_t count = samples.size();
  for (std::size_t k = 0; k < count; ++k) {
    const float x = coordinate(samples[k].position, axis);
    if (x >= low && x < low + reach) samples.push_back(shifted(samples[k], axis, high - low));
    if (x <= high && x > high - reach) samples.push_back(shifted(samples[k], axis, low - high));
  }
}

}  // namespace

std::vector<PlacedSample> place_with_images(const Region& patch, const std::array<Edge, 3>& edges, float reach,
                                            float spacing, std::span<const Float4> samples) {
  std::vector<PlacedSample> placed;
  placed.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k)
    placed.push_back({samples[k], static_cast<std::uint32_t>(k), {1, 1, 1, 1}});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (edges[axis] == Edge::kMirror) mirror_across(axis, patch, reach, spacing, placed);
    if (edges[axis] == Edge::kPeriodic) repeat_across(axis, patch, reach, placed);
  }
  return placed;
}

}  // namespace pelagos
