#include "waves/dispersion.hpp"

#include <cmath>

namespace pelagos {

double wave_frequency(double wavenumber, double depth, double gravity) {
  return std::sqrt(gravity * wavenumber * std::tanh(wavenumber * depth));
}

double wave_number(double omega, double depth, double gravity) {
  const double deep = omega * omega / gravity;
  if (std::isinf(depth)) return deep;
  // In x = k h and q = omega^2 h / g: x tanh x = q. Guo's start is within 0.75 %; Newton doubles the digits each time.
  const double q = deep * depth, beta = 2.4908;
  double x = q * std::pow(1.0 - std::exp(-std::pow(q, 0.5 * beta)), -1.0 / beta);
  constexpr int kSteps = 4;
  for (int step = 0; step < kSteps; ++step) {
    const double t = std::tanh(x);
    x -= (x * t - q) / (t + x * (1.0 - t * t));
  }
  return x / depth;
}

}  // namespace pelagos
