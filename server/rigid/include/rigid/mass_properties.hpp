#pragma once

#include <Eigen/Core>

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// A solid of density 1 kg/m^3. Multiply by a density for masses in kg.
struct MassProperties {
  double volume = 0.0;                                ///< m^3
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< m, body axes: of the volume
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< m^5, about the centre, along the body's axes
};

/// Exact for the mesh. The same integrals over the volume that Mirtich (1996, "Fast and accurate computation of
/// polyhedral mass properties") and Eberly (2002, "Polyhedral mass properties") reduce to sums over faces; here over
/// the tetrahedra between each triangle and one point, with
///   int x x^T dV = V/20 [a a^T + b b^T + c c^T + (a + b + c)(a + b + c)^T]        corners a, b, c and the origin
/// @param mesh  closed, without faults; of parts that overlap the boundary of their union (unite_parts), or the overlap
///              counts twice
[[nodiscard]] MassProperties mass_properties(const TriangleMesh& mesh);

}  // namespace pelagos
