#pragma once

namespace pelagos {

/// Drag coefficient of the sea's surface for the wind at 10 m (m/s), no unit: Large and Pond 1981, 1.15e-3 below
/// 10.15385 m/s and (0.49 + 0.065 U) 1e-3 above. Measured from 4 to 26 m/s; beyond that it is held at the value of
/// 33 m/s, as measured in hurricanes it no longer grows (Powell, Vickery and Reinhold 2003).
[[nodiscard]] double sea_drag_coefficient(double speed);

}  // namespace pelagos
