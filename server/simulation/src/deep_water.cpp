#include "simulation/deep_water.hpp"

#include <algorithm>

namespace pelagos {

namespace {

constexpr double kShallow = 30.0, kDeep = 60.0;  // layers: where the filter starts to grow, where it is twice as strong
constexpr double kShortStepsFrom = 40.0;         // layers

}  // namespace

DepthMeasures depth_measures(Scheme scheme, double layers) {
  DepthMeasures measures;
  if (scheme != Scheme::kCorrected) return measures;
  measures.filter_factor = std::clamp(layers / kShallow, 1.0, kDeep / kShallow);
  measures.step_factor = std::min(1.0, kShortStepsFrom / std::max(layers, 1.0));
  return measures;
}

double depth_in_spacings(const Scene& scene) {
  if (!(scene.gravity > 0.0)) return 0.0;
  Eigen::AlignedBox<double, 1> heights;
  const auto add = [&](const Box& block) {
    heights.extend(Eigen::Matrix<double, 1, 1>(block.min.z())).extend(Eigen::Matrix<double, 1, 1>(block.max.z()));
  };
  for (const Box& block : scene.water.blocks) add(block);
  if (scene.oil)
    for (const Box& block : scene.oil->blocks) add(block);
  return heights.isEmpty() ? 0.0 : heights.sizes()(0) / scene.particle_spacing;
}

}  // namespace pelagos
