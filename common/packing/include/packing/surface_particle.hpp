#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace pelagos {

/// A particle as a viewer draws it: an ellipsoid with velocity. Positions are relative to the origin of its frame.
/// The anisotropy transform of the paper (eq. 52), T = R diag(semi_axes).
struct SurfaceParticle {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m, smoothed (paper eq. 53), relative to the frame's origin
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();  ///< R: ellipsoid axes to world, unit
  Eigen::Vector3f semi_axes = Eigen::Vector3f::Ones();              ///< m, > 0, descending
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();               ///< m/s, world
  std::uint8_t phase = 0;                                           ///< 0 water, 1 oil
  std::uint8_t foam = 0;                                            ///< 0 none .. 255 white
  std::uint8_t spray = 0;                                           ///< 0 bulk .. 255 isolated drop
};

}  // namespace pelagos
