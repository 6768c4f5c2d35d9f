#pragma once

#include <cmath>

namespace pelagos {

/// Cubic spline kernel in three dimensions with compact support (Monaghan 1992), written with truncated powers:
///   W(r) = sigma [2 (1 - q)+^3 - 8 (1/2 - q)+^3],   q = r / support_radius,   sigma = 8 / (pi support_radius^3)
/// It integrates to one over its support.
struct CubicSpline {
  float support_radius = 1.0F;  ///< m; W and its gradient vanish from here on
  float sigma = 0.0F;           ///< 1/m^3

  explicit CubicSpline(double radius)
      : support_radius(static_cast<float>(radius)),
        sigma(static_cast<float>(8.0 / (M_PI * radius * radius * radius))) {}

  /// W at distance r (m), in 1/m^3.
  [[nodiscard]] float value(float r) const {
    const float q = r / support_radius;
    const float a = std::fmax(1.0F - q, 0.0F), b = std::fmax(0.5F - q, 0.0F);
    return sigma * (2.0F * a * a * a - 8.0F * b * b * b);
  }

  /// dW/dr at distance r (m), in 1/m^4; never positive.
  [[nodiscard]] float derivative(float r) const {
    const float q = r / support_radius;
    const float a = std::fmax(1.0F - q, 0.0F), b = std::fmax(0.5F - q, 0.0F);
    return sigma / support_radius * (-6.0F * a * a + 24.0F * b * b);
  }
};

}  // namespace pelagos
