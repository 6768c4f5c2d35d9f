#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "values/scene.hpp"

namespace pelagos {

/// How many particles stand along each axis of a block that starts full of water: at d, 2d, ... from its min corner,
/// size/d - 1 of them, 0 where there is room for none. A size within 1e-6 spacings of a multiple of d counts as that
/// multiple (1.5 / 0.05 is 29.999...). Counts beyond 10^9 along one axis are given as 10^9.
[[nodiscard]] inline std::array<std::int64_t, 3> lattice_counts(const Box& block, double spacing) {
  std::array<std::int64_t, 3> counts{};
  for (int axis = 0; axis < 3; ++axis) {
    const double intervals = std::floor(block.size()[axis] / spacing + 1e-6);
    counts[static_cast<std::size_t>(axis)] =
        intervals < 2.0 ? 0 : static_cast<std::int64_t>(std::fmin(intervals - 1.0, 1e9));
  }
  return counts;
}

/// Particles that the blocks of a scene make, before any that would stand inside a body are taken out. A double, so
/// that no scene overflows it; exact up to 2^53.
[[nodiscard]] inline double particle_count(const Box& block, double spacing) {
  const auto counts = lattice_counts(block, spacing);
  return static_cast<double>(counts[0]) * static_cast<double>(counts[1]) * static_cast<double>(counts[2]);
}
[[nodiscard]] inline double particle_count(const Scene& scene) {
  double total = 0.0;
  for (const Box& block : scene.water.blocks) total += particle_count(block, scene.particle_spacing);
  return total;
}

}  // namespace pelagos
