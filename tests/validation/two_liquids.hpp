#pragma once

#include <array>
#include <functional>

#include "oil_scene.hpp"  // of tests/physics: what unit tests measure of two liquids, too
#include "water_run.hpp"

namespace pelagos::validation {

using test::deepest_intruder;

// Cases of oil and water: slices in the x, z plane, four spacings along the periodic y axis.

inline constexpr int kSliceOfTwo = 4;  ///< spacings

/// A box between mirrors in x and z (x may be periodic), filled with two liquids up to a height.
struct TwoLiquids {
  double length = 1.0, height = 1.0, filled = 1.0;  ///< m
  double spacing = 0.05;                            ///< m
  double oil_density = 800.0;                       ///< kg/m^3; the water has 1000
  bool periodic = false;                            ///< along x

  [[nodiscard]] FluidParameters parameters() const;
  /// @param is_oil  by x and z, m
  [[nodiscard]] Start start(const std::function<bool(double, double)>& is_oil) const;
};

/// Amplitude a of the interface's mode a cos(k x), m, from the area of oil over x: the mean over the slice and free of
/// how particles happen to lie. Positive where oil reaches further up (oil below) or down (oil above) at x = 0.
[[nodiscard]] double oil_mode(const FluidState& state, double wave_number, double length);

/// x that the given share of the oil (or water) particles stays below, m.
[[nodiscard]] double quantile_x(const FluidState& state, bool oil, double share);

}  // namespace pelagos::validation
