#pragma once

#include <Eigen/Core>

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// A level water surface seen from the body: wet is what has up . x < level.
struct WaterPlane {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit, body axes
  double level = 0.0;                             ///< m, from the body's origin along `up`
};

/// A body at rest in still water.
struct Hydrostatics {
  double volume = 0.0;                                            ///< m^3, displaced
  Eigen::Vector3d centre_of_buoyancy = Eigen::Vector3d::Zero();   ///< m, body axes; zero where nothing is wet
  double wetted_area = 0.0;                                       ///< m^2, of the mesh below the water
  double waterplane_area = 0.0;                                   ///< m^2, of the cut
  Eigen::Vector3d centre_of_flotation = Eigen::Vector3d::Zero();  ///< m, body axes: centre of the waterplane
  /// m^4, second moments of the waterplane about its centre: int r r^T dA, r in the plane. Over `volume` they are
  /// metacentric radii (for up = z: (1, 1) / volume for heel about x is int y^2 dA / volume).
  Eigen::Matrix3d waterplane_moments = Eigen::Matrix3d::Zero();
};

/// Exact for the mesh: triangles are clipped at the plane; volume and moments are sums over tetrahedra with their apex
/// in the plane, so that the lid which would close the clipped mesh adds nothing. The waterplane is that lid: the wet
/// triangles' projection, with its sign turned.
/// @param mesh  closed, without faults; of parts that overlap the boundary of their union (unite_parts), or the overlap
///              counts twice
[[nodiscard]] Hydrostatics hydrostatics(const TriangleMesh& mesh, const WaterPlane& water);

}  // namespace pelagos
