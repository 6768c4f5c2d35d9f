#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

/// Water that moves as it is given, such as the rim of an open sea: particles whose label has w = kHeld. They are
/// neighbours like all others. The solves do not move them; their pressure is that of the depth at which they rest,
/// -g label.z, as linear theory in Lagrange's coordinates has it: a material surface label.z = const is an isobar.
/// Corrected scheme only.
struct HeldWater {
  std::vector<std::uint32_t> rows;  ///< where they are in the arrays of particles, in their order
  /// For each of `rows`, m and m/s: place and velocity at the end of the coming step, set before it by whoever gives
  /// them. The velocity counts in the solve of that step.
  std::vector<Float4> position, velocity;
  std::vector<float> pressure;  ///< m^2, of the present solve
};

}  // namespace pelagos
