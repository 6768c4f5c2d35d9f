#include "two_liquids.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos::validation {

FluidParameters TwoLiquids::parameters() const {
  FluidParameters p = patch_parameters({length, kSliceOfTwo * spacing, height}, spacing,
                                       {periodic ? Edge::kPeriodic : Edge::kMirror, Edge::kPeriodic, Edge::kMirror});
  p.oil = PhaseParameters{oil_density, -1.0};
  return p;
}

Start TwoLiquids::start(const std::function<bool(double, double)>& is_oil) const {
  Start start = fill_block(parameters(), {length, kSliceOfTwo * spacing, filled});
  for (const Float4& p : start.positions)
    start.phase.push_back(is_oil(static_cast<double>(p.x), static_cast<double>(p.z)) ? kOilPhase : kWaterPhase);
  return start;
}

double oil_mode(const FluidState& state, double wave_number, double length) {
  const double d = state.parameters.spacing;
  double sum = 0.0;
  for (std::size_t i = 0; i < state.particles.count; ++i)
    if (state.particles.phase[i] == kOilPhase)
      sum += std::cos(wave_number * static_cast<double>(state.particles.position[i].x));
  return 2.0 / length * sum * d * d / kSliceOfTwo;
}

double quantile_x(const FluidState& state, bool oil, double share) {
  std::vector<double> x;
  for (std::size_t i = 0; i < state.particles.count; ++i)
    if ((state.particles.phase[i] == kOilPhase) == oil) x.push_back(static_cast<double>(state.particles.position[i].x));
  const auto at =
      x.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(share * static_cast<double>(x.size())),
                                           static_cast<std::ptrdiff_t>(x.size()) - 1);
  std::nth_element(x.begin(), at, x.end());
  return *at;
}

}  // namespace pelagos::validation
