#include "simulation/deep_water.hpp"

#include <algorithm>

namespace pelagos {

namespace {

constexpr double kShallow = 30.0, kDeep = 60.0;  // layers: where the filter starts to grow, where it is twice as strong
constexpr double kSpreadFrom = 40.0;             // layers: from here on the repair is spread over steps
constexpr int kRepairIterations = 4;             // 8 and more let water of 80 layers collapse

}  // namespace

DepthMeasures depth_measures(Scheme scheme, double layers) {
  DepthMeasures measures;
  if (scheme != Scheme::kCorrected) return measures;
  measures.filter_factor = std::clamp(layers / kShallow, 1.0, kDeep / kShallow);
  if (layers > kSpreadFrom) measures.repair_iterations = kRepairIterations;
  measures.step_factor = std::min(1.0, kDeep / std::max(layers, 1.0));
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

void suit_depth(double layers, FluidParameters& parameters) {
  const DepthMeasures measures = depth_measures(parameters.scheme, layers);
  parameters.filter *= measures.filter_factor;
  parameters.repair_iterations = measures.repair_iterations;
}

}  // namespace pelagos
