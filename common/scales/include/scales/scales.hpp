#pragma once

#include <cmath>

namespace pelagos {

/// Standard gravity as Pelagos takes it, m/s^2.
inline constexpr double kStandardGravity = 9.81;

/// Density of the water where a scene does not say otherwise, kg/m^3.
inline constexpr double kUsualWaterDensity = 1000.0;

/// The given gravity, or the standard one for what needs a scale where there is none; m/s^2.
[[nodiscard]] constexpr double scale_gravity(double gravity) { return gravity > 0.0 ? gravity : kStandardGravity; }

/// The longest step that a scene takes unless it says otherwise, in units of sqrt(d / g).
inline constexpr double kUsualStep = 0.07;

/// The same in s; infinite without gravity.
[[nodiscard]] inline double usual_step(double spacing, double gravity) {
  return kUsualStep * std::sqrt(spacing / gravity);
}

}  // namespace pelagos
