#pragma once

#include <cmath>

namespace pelagos {

/// Mean wind speed at 10 m of a Beaufort number, m/s: v = 0.836 B^1.5 (the relation behind the scale of 1946,
/// World Meteorological Organization, code 1100). Lies within the bounds of its force for B = 0 to 12.
[[nodiscard]] inline double beaufort_speed(int beaufort) {
  const double number = beaufort;
  return 0.836 * number * std::sqrt(number);
}

}  // namespace pelagos
