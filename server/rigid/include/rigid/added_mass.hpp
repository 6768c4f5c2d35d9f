#pragma once

#include <Eigen/Core>

namespace pelagos {

/// Added mass of an ellipsoid in water without bounds, as multiples of the mass of the water that it displaces: along
/// its axes, and about them in m^2.
struct AddedMass {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  Eigen::Vector3d about = Eigen::Vector3d::Zero();  ///< m^2
};

/// Lamb (1932), sections 114 and 115, with a0, b0, c0 the integrals abc int_0^inf dl / ((a^2 + l) D), D^2 = (a^2 + l)
/// (b^2 + l) (c^2 + l):
///   along x: a0 / (2 - a0)     about x: (b^2 - c^2)^2 (c0 - b0) / (5 [2 (b^2 - c^2) + (b^2 + c^2) (b0 - c0)])
/// Half of it, cut at the water's surface, has the same multiples of its own displaced mass where the waves that it
/// makes are long (Newman 1977, section 4.16: the double body).
/// @param semi_axes  m, > 0
[[nodiscard]] AddedMass ellipsoid_added_mass(const Eigen::Vector3d& semi_axes);

}  // namespace pelagos
