#include "physics/pressure.hpp"

#include <algorithm>
#include <cassert>

namespace pelagos {

void compute_pressure(const FluidState& state, std::span<float> pressure) {
  const FluidParticles& p = state.particles;
  assert(pressure.size() >= p.count);
  if (!(state.last_dt > 0.0) || state.work.pressure.size() < p.count) {
    std::fill_n(pressure.begin(), p.count, 0.0F);
    return;
  }
  const auto factor = static_cast<float>(state.parameters.rest_density / (state.last_dt * state.last_dt));
  // The velocity solve is the last one of a corrected step: its pressure still lies in the workspace.
  if (state.parameters.scheme == Scheme::kCorrected)
    for (std::size_t i = 0; i < p.count; ++i) pressure[i] = factor * state.work.pressure[i];
  else
    for (std::size_t i = 0; i < p.count; ++i) pressure[i] = factor * (p.density_pressure[i] + p.divergence_pressure[i]);
}

}  // namespace pelagos
