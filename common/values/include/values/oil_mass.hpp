#pragma once

#include <cmath>
#include <cstdint>

namespace pelagos {

/// Oil is counted in whole milligrams, so that the ledger's sum is exact; 2^63 mg are 9.2e12 kg.
using Milligrams = std::int64_t;

/// Most oil that one call may bring, kg: a million tonnes, more than any ship carries.
inline constexpr double kMostOilMass = 1e9;

/// To the nearest milligram. |kilograms| <= 1e12.
[[nodiscard]] inline Milligrams to_milligrams(double kilograms) { return std::llround(kilograms * 1e6); }
[[nodiscard]] inline double to_kilograms(Milligrams mass) { return static_cast<double>(mass) * 1e-6; }

}  // namespace pelagos
