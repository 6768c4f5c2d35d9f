#pragma once

#include <cmath>
#include <limits>

#include "pair_scene.hpp"
#include "physics/water_step.hpp"

namespace pelagos::test {

/// Water in a closed patch, advanced the way the simulation does it.
class WaterScene {
 public:
  WaterScene(int threads, const FluidParameters& parameters, std::span<const Float4> points,
             std::span<const std::uint8_t> phase = {})
      : pool(threads), state(make_fluid(pool, parameters, points, phase)) {}

  StepReport step(double dt) { return step_water(pool, state, dt); }
  [[nodiscard]] double largest_step() const {
    return 0.07 * std::sqrt(state.parameters.spacing / std::max(state.parameters.gravity, 9.81));
  }
  [[nodiscard]] StepReport measure() {
    StepReport report;
    measure_fluid(pool, state, 0.0, report);
    return report;
  }
  /// Where each particle is by its identity: the sort changes places.
  [[nodiscard]] std::vector<std::size_t> place_of_id() const {
    std::vector<std::size_t> place(state.particles.count, std::numeric_limits<std::size_t>::max());
    for (std::size_t k = 0; k < state.particles.count; ++k)
      if (state.particles.id[k] < place.size()) place[state.particles.id[k]] = k;
    return place;
  }

  TaskPool pool;
  FluidState state;
};

inline FluidParameters patch_parameters(const Double3& size, double spacing) {
  FluidParameters p;
  p.spacing = spacing;
  p.support_radius = 2.0 * spacing;
  p.viscosity = 0.01 * std::pow(spacing / 0.05, 1.5);
  for (std::size_t a = 0; a < 3; ++a) p.patch.max[a] = static_cast<float>(size[a]);
  return p;
}

/// A column of 10 x 9 x 13 particles (or n) in the corner of a patch three times as long.
inline WaterScene small_dam_break(int threads, const std::array<int, 3>& n = {10, 9, 13}) {
  const double d = 0.05;
  return {threads, patch_parameters({3.0 * (n[0] + 1) * d, (n[1] + 1) * d, 2.0 * (n[2] + 1) * d}, d),
          lattice(n, d, {d, d, d})};
}

}  // namespace pelagos::test
