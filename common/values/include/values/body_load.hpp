#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace pelagos {

/// What the water does to a body, averaged over the steps of a frame. Forces in N, moments in N m, body axes.
struct BodyLoad {
  std::uint32_t body = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< m, body axes: what the moments are about
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< of the water on the body; its weight is no part of it
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about `point`
  /// Part of them that still water would make on what is below the surface now; the rest is dynamic.
  Eigen::Vector3d buoyant_force = Eigen::Vector3d::Zero();
  Eigen::Vector3d buoyant_moment = Eigen::Vector3d::Zero();
  double peak_force = 0.0;     ///< N, the largest of any single step of the frame
  double peak_moment = 0.0;    ///< N m, likewise
  double wetted_volume = 0.0;  ///< m^3, of the body below the water's surface
  double wetted_area = 0.0;    ///< m^2, of its skin below the surface
};

}  // namespace pelagos
