#pragma once

#include <limits>

namespace pelagos {

/// Depth of water without a bottom.
inline constexpr double kInfiniteDepth = std::numeric_limits<double>::infinity();

/// Frequency of a linear wave, rad/s: omega^2 = g k tanh(k h) (Airy 1845).
/// @param wavenumber rad/m, > 0   @param depth m, > 0, kInfiniteDepth allowed   @param gravity m/s^2, > 0
[[nodiscard]] double wave_frequency(double wavenumber, double depth, double gravity);

/// Wave number of a linear wave, rad/m: the inverse of wave_frequency, by Newton's method from the approximation of
/// Guo (2002, "Simple and explicit solution of wave dispersion equation"). Relative error below 1e-14.
/// @param omega rad/s, > 0
[[nodiscard]] double wave_number(double omega, double depth, double gravity);

}  // namespace pelagos
