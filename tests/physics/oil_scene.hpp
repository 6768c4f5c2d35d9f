#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "water_scene.hpp"

namespace pelagos::test {

/// Rest density of every particle, kg/m^3.
inline double density_of(const FluidState& state, std::size_t i) {
  const bool oil = !state.particles.phase.empty() && state.particles.phase[i] == kOilPhase;
  return oil ? state.parameters.oil->rest_density : state.parameters.rest_density;
}

/// sum_i rho0_i v_i and sum_i rho0_i |v_i|, kg/m^2/s.
struct PhaseMomentum {
  Double3 sum{};
  double scale = 0;
};
inline PhaseMomentum momentum_of(const FluidState& state) {
  PhaseMomentum total;
  for (std::size_t i = 0; i < state.particles.count; ++i) {
    const Double3 v = as_double(state.particles.velocity[i]);
    for (std::size_t c = 0; c < 3; ++c) total.sum[c] += density_of(state, i) * v[c];
    total.scale += density_of(state, i) * std::sqrt(dot(v, v));
  }
  return total;
}

/// Mean height of a phase, m.
inline double mean_height_of(const FluidState& state, std::uint8_t phase) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < state.particles.count; ++i) {
    if (state.particles.phase[i] != phase) continue;
    sum += static_cast<double>(state.particles.position[i].z);
    ++count;
  }
  return sum / count;
}
/// Mean vertical velocity of a phase, m/s.
inline double mean_rise_of(const FluidState& state, std::uint8_t phase) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < state.particles.count; ++i) {
    if (state.particles.phase[i] != phase) continue;
    sum += static_cast<double>(state.particles.velocity[i].z);
    ++count;
  }
  return sum / count;
}

/// How far the particles on the wrong side of the interface have gone, m; the interface is where as many particles lie
/// below it as the lower phase has.
inline double deepest_intruder(const FluidState& state, bool oil_above) {
  const std::size_t count = state.particles.count;
  const std::size_t below = oil_above ? count - state.oil_count : state.oil_count;
  std::vector<double> height;
  for (std::size_t i = 0; i < count; ++i) height.push_back(static_cast<double>(state.particles.position[i].z));
  std::sort(height.begin(), height.end());
  const double interface = 0.5 * (height[below - 1] + height[below]);
  double deepest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool above = (state.particles.phase[i] == kOilPhase) == oil_above;
    const double z = static_cast<double>(state.particles.position[i].z);
    deepest = std::max(deepest, above ? interface - z : z - interface);
  }
  return deepest;
}

/// Oil where the test says so.
inline std::vector<std::uint8_t> mark_oil(std::span<const Float4> points,
                                          const std::function<bool(const Float4&)>& is_oil) {
  std::vector<std::uint8_t> phase;
  for (const Float4& p : points) phase.push_back(is_oil(p) ? kOilPhase : kWaterPhase);
  return phase;
}

/// The parameters that a scheme runs with, as the simulation sets them: the corrected scheme needs no viscosity of its
/// own, and repairs only when it must.
inline FluidParameters with_scheme(FluidParameters parameters, Scheme scheme,
                                   SolveMethod method = SolveMethod::kConjugateGradient) {
  parameters.scheme = scheme;
  parameters.density.method = parameters.divergence.method = method;
  if (scheme == Scheme::kCorrected) {
    parameters.viscosity = 0.0;
    parameters.density.min_iterations = 0;
  } else {
    parameters.divergence.min_iterations = 1;
  }
  return parameters;
}

}  // namespace pelagos::test
