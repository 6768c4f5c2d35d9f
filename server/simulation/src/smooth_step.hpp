#pragma once

#include <algorithm>

namespace pelagos {

/// 0 up to t = 0, 1 from t = 1 on, and 3 t^2 - 2 t^3 between them.
inline double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace pelagos
