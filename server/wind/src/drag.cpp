#include "wind/drag.hpp"

#include <algorithm>

namespace pelagos {

double sea_drag_coefficient(double speed) {
  constexpr double kKnee = 10.15385, kSaturation = 33.0;  // m/s
  if (!(speed > kKnee)) return 1.15e-3;
  return (0.49 + 0.065 * std::min(speed, kSaturation)) * 1e-3;
}

}  // namespace pelagos
