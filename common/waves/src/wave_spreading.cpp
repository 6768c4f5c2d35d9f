#include "waves/wave_spreading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pelagos {

namespace {

constexpr double kLeastExponent = 0.5;  ///< of short waves far above the peak, by frequency

}  // namespace

double spreading_exponent(const WaveSystem& system, double ratio) {
  switch (system.spreading_kind) {
    case SpreadingKind::kLongCrested:
      return std::numeric_limits<double>::infinity();
    case SpreadingKind::kConstant:
      return system.spreading;
    case SpreadingKind::kByFrequency:
      break;
  }
  const double falls = ratio < 1.0 ? std::pow(ratio, 5.0) : std::pow(ratio, -2.5);
  return std::max(system.spreading * falls, std::min(system.spreading, kLeastExponent));
}

double spreading_angle_of(double s, double quantile) {
  if (std::isinf(s)) return 0.0;
  // cos^2s(theta/2) is about exp(-s theta^2 / 4): beyond 10 of its widths there is nothing.
  constexpr int kSteps = 512;
  const double width = std::min(std::numbers::pi, 10.0 * std::sqrt(2.0 / s));
  std::array<double, kSteps + 1> below{};
  const auto angle = [&](double step) { return width * (2.0 * step / kSteps - 1.0); };
  const auto density = [&](int step) { return std::pow(std::max(std::cos(0.5 * angle(step)), 0.0), 2.0 * s); };
  double last = density(0);
  for (int step = 1; step <= kSteps; ++step) {
    const double next = density(step);
    below[static_cast<std::size_t>(step)] = below[static_cast<std::size_t>(step - 1)] + 0.5 * (last + next);
    last = next;
  }
  const double wanted = std::clamp(quantile, 0.0, 1.0) * below.back();
  const auto above = std::upper_bound(below.begin() + 1, below.end() - 1, wanted);
  const auto step = static_cast<std::size_t>(above - below.begin());
  const double rise = below[step] - below[step - 1];
  const double part = rise > 0.0 ? (wanted - below[step - 1]) / rise : 0.5;
  return angle(static_cast<double>(step - 1) + part);
}

}  // namespace pelagos
