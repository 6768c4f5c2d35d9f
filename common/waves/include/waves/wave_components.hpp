#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace pelagos {

/// One long-crested deep-water wave of the far sea: elevation a cos(k . x - omega t + phase), running TOWARDS
/// direction.
struct WaveComponent {
  float amplitude = 0;   ///< m
  float wavenumber = 0;  ///< rad/m
  float omega = 0;       ///< rad/s, omega^2 = g k
  float direction = 0;   ///< rad, anticlockwise from east (x), the way the crests move
  float phase = 0;       ///< rad
};

}  // namespace pelagos
