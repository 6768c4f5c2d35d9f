#pragma once

#include <complex>
#include <span>
#include <vector>

#include "physics/fluid.hpp"

namespace pelagos::validation {

/// A wave of small amplitude over a flat bottom at z = 0. Surface: level + amplitude cos(k x - omega t), or standing:
/// level + amplitude cos(k x) cos(omega t).
struct LinearWave {
  double wavenumber = 0;  ///< k, 1/m
  double depth = 0;       ///< m
  double gravity = 9.81;  ///< m/s^2

  [[nodiscard]] double frequency() const;  ///< omega = sqrt(g k tanh(k h)), 1/s
  [[nodiscard]] double period() const;     ///< s
  /// Horizontal and vertical orbital motion at height z per amplitude: cosh(k z) / sinh(k h), sinh(k z) / sinh(k h).
  [[nodiscard]] double horizontal(double z) const;
  [[nodiscard]] double vertical(double z) const;
};

/// Frequency of a standing wave of finite height over the linear one, second order (Tadjbakhsh and Keller 1960); deep:
/// 1 - (ka)^2 / 8.
[[nodiscard]] double standing_frequency_ratio(const LinearWave& wave, double amplitude);

/// Moves lattice particles by the wave's displacement at t = 0 and returns the matching velocities (at rest if it
/// stands). The particles of a travelling wave then go round in closed orbits without drift: in deep water Gerstner's
/// exact wave, whose frequency is the linear one at any height.
[[nodiscard]] std::vector<Float4> start_wave(const LinearWave& wave, double amplitude, bool standing,
                                             std::span<Float4> positions);

/// Fourier amplitude of the surface, m: eta_k = 2 / (length width) sum V exp(-i k x) over all particles. The volume
/// over a stretch of x is the height of the water there, so this is the surface's own mode, without finding a surface.
/// `length` and `width` are those of the patch; k fits it, or half of it between mirrors.
[[nodiscard]] std::complex<double> surface_mode(const FluidParticles& particles, double volume, double wavenumber,
                                                double length, double width);

/// Least-squares fit of the wave's orbital velocities to those of the particles.
struct VelocityFit {
  std::complex<double> amplitude;  ///< m
  double noise = 0;                ///< rms of what the fit leaves over the rms of the fit
};
[[nodiscard]] VelocityFit fit_velocity(const LinearWave& wave, const FluidParticles& particles);

}  // namespace pelagos::validation
