#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "packing/surface_particle.hpp"

namespace pelagos {

/// Which particles have left the body of the water: 1 for those of a clump that touches nothing and has fewer than
/// kLeastBody particles, else 0. The largest clump is water, whatever its size. They are drawn as spray: as ellipsoids
/// they would look like boulders.
/// @param spacing  m, > 0: particles touch where the cells of that width touch that they lie in
[[nodiscard]] std::vector<std::uint8_t> find_loose_water(std::span<const SurfaceParticle> particles, double spacing);

inline constexpr std::uint32_t kLeastBody = 60;

}  // namespace pelagos
