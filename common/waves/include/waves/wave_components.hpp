#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
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

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("amplitude", self.amplitude);
    visit("wavenumber", self.wavenumber);
    visit("omega", self.omega);
    visit("direction", self.direction);
    visit("phase", self.phase);
  }
};

/// The surface z = elevation(x, y, t) of linear theory at one point.
struct WaveSurface {
  double elevation = 0.0;                           ///< m above the mean level
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< d elevation / dx, d elevation / dy
  double rate = 0.0;                                ///< d elevation / dt, m/s
};

/// Elevation above the mean level, m, at world position (x, y) in m and simulation time t in s.
[[nodiscard]] double wave_elevation(std::span<const WaveComponent> components, double x, double y, double t);

/// Elevation with its slopes and rate.
[[nodiscard]] WaveSurface wave_surface(std::span<const WaveComponent> components, double x, double y, double t);

/// Displacement of the surface particle whose place at rest is (x, y): crests sharpen, troughs flatten.
///   horizontal: -sum a k^ sin(theta) ;  vertical: sum (a cos(theta) + k a^2 / 2) ;  theta = k . x - omega t + phase
/// The Lagrangian first-order solution; the last term keeps the mean level of the displaced surface at zero.
[[nodiscard]] Eigen::Vector3d wave_displacement(std::span<const WaveComponent> components, double x, double y,
                                                double t);

/// Mean of elevation^2, m^2: sum a^2 / 2. The significant wave height is 4 sqrt(variance).
[[nodiscard]] double wave_variance(std::span<const WaveComponent> components);

}  // namespace pelagos
