#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "channels/rig.hpp"
#include "values/body.hpp"

namespace pelagos {

/// A pinhole camera in the world (ENU, z up). Depth is linear: metres along the viewing axis.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();                  ///< m, world
  Eigen::Matrix3d view_from_world = Eigen::Matrix3d::Identity();  ///< rows: right, up, forward
  double tan_half_x = 1.0;                                        ///< tangent of half the horizontal field of view
  double tan_half_y = 1.0;
  int width = 1, height = 1;  ///< pixels
  int guard = 0;              ///< pixels drawn around the picture by the fluid passes

  [[nodiscard]] double focal_pixels() const { return 0.5 * width / tan_half_x; }
  /// World direction through normalised picture coordinates (-1..1, x to the right, y up), with unit depth.
  [[nodiscard]] Eigen::Vector3d ray(double x, double y) const {
    return view_from_world.transpose() * Eigen::Vector3d(x * tan_half_x, y * tan_half_y, 1.0);
  }
};

/// Heading of a body, rad anticlockwise from east (x): the horizontal direction of its forward axis.
[[nodiscard]] double heading_of(const Eigen::Quaterniond& orientation);

/// A body's state `seconds` later at constant velocity and turn rate.
[[nodiscard]] BodyState extrapolate(const BodyState& body, double seconds);

/// The camera of a channel. Nothing if the channel rides on a body that is not among `bodies`.
[[nodiscard]] std::optional<Camera> camera_for(const Channel& channel, std::span<const BodyState> bodies, int width,
                                               int height);

}  // namespace pelagos
