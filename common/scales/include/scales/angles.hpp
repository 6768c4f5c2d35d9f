#pragma once

#include <numbers>

namespace pelagos {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// The fractional part of the golden ratio: its multiples, modulo 1, spread evenly whatever their number.
inline constexpr double kGoldenPart = std::numbers::phi - 1.0;

}  // namespace pelagos
