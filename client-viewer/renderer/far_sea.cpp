#include "renderer/far_sea.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace pelagos {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr int kSectors = 720;
constexpr double kHorizon = 30'000.0;  // m

/// The grid depends on the power of two of the height only, so that a heaving eye does not make it swim.
double height_step(double height) { return std::exp2(std::round(std::log2(std::clamp(height, 2.0, 512.0)))); }

}  // namespace

std::vector<float> ring_radii(double height, double coarseness) {
  std::vector<float> radii = {0.0F};
  double radius = 0.0;
  while (radius < kHorizon) {
    radius += coarseness * std::max(0.026 * std::hypot(radius, height), radius * radius / (height * 900.0));
    radii.push_back(static_cast<float>(std::min(radius, 1.2 * kHorizon)));
  }
  return radii;
}

SectorRange visible_sectors(const Camera& camera, int around) {
  const Eigen::Vector3d forward = camera.view_from_world.row(2);
  const double middle = std::atan2(forward.y(), forward.x());
  double spread = 0.0;
  for (const double y : {-1.0, 0.0, 1.0})
    for (const double x : {-1.0, 0.0, 1.0}) {
      const Eigen::Vector3d ray = camera.ray(x, y);
      if (ray.head<2>().norm() < 0.35 * ray.norm()) return {0, around};  // looks almost straight down (or up)
      const double off = std::remainder(std::atan2(ray.y(), ray.x()) - middle, kTwoPi);
      spread = std::max(spread, std::abs(off));
    }
  spread += 8.0 * kTwoPi / 360.0;  // waves shift the grid sideways
  if (spread > 0.45 * kTwoPi) return {0, around};
  const int first = static_cast<int>(std::floor((middle - spread) / kTwoPi * around));
  const int last = static_cast<int>(std::ceil((middle + spread) / kTwoPi * around));
  return {((first % around) + around) % around, last - first};
}

FarSeaPass::FarSeaPass(int width, int height, double coarseness)
    : program_("far_sea.vert", "far_sea.frag"),
      surface_(width, height, GL_RGBA32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      target_({&surface_}, true),
      coarseness_(coarseness) {}

void FarSeaPass::prepare_grid(double height) {
  const double step = height_step(height);
  if (step == grid_height_) return;
  grid_height_ = step;
  const std::vector<float> radii = ring_radii(step, coarseness_);
  ring_count_ = static_cast<int>(radii.size());
  rings_.upload(radii.data(), radii.size() * sizeof(float), GL_STATIC_DRAW);
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(kSectors) * radii.size() * 6);
  const auto rings = static_cast<std::uint32_t>(ring_count_);
  for (std::uint32_t sector = 0; sector < kSectors; ++sector)
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t a = sector * rings + ring, b = a + rings;
      for (const std::uint32_t index : {a, a + 1, b + 1, a, b + 1, b}) indices.push_back(index);
    }
  indices_.upload(indices.data(), indices.size() * sizeof(std::uint32_t), GL_STATIC_DRAW);
  glVertexArrayElementBuffer(array_.id(), indices_.id());
}

Eigen::Vector3d FarSeaPass::grid_for(double height) const {
  return {coarseness_, height_step(height), kTwoPi / kSectors};
}

void FarSeaPass::draw(const Camera& camera, double height, const WaveMoment& waves, double carried_by_patch) {
  prepare_grid(height);
  longest_first_.assign(waves.waves.begin(), waves.waves.end());
  std::stable_sort(longest_first_.begin(), longest_first_.end(),
                   [](const MomentWave& a, const MomentWave& b) { return a.wavenumber < b.wavenumber; });
  waves_.upload(longest_first_.data(), longest_first_.size() * sizeof(MomentWave));
  const SectorRange sectors = visible_sectors(camera, kSectors);
  target_.begin_solids();
  program_.use();
  program_.set("rings", ring_count_);
  program_.set("first_sector", sectors.first);
  program_.set("sectors_around", kSectors);
  program_.set("wave_count", static_cast<int>(waves.waves.size()));
  program_.set("carried_by_patch", static_cast<float>(carried_by_patch));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, rings_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, waves_.id());
  array_.bind();
  glDrawElements(GL_TRIANGLES, sectors.count * (ring_count_ - 1) * 6, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace pelagos
