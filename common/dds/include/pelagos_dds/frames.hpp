#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pelagos {

// World frames and body axes. ENU: x east, y north, z up, with body axes x forward, y port, z up.
// NED: x north, y east, z down, with body axes x forward, y starboard, z down. Each conversion is its own inverse.

/// Vector in world axes, ENU to NED or back: (x, y, z) -> (y, x, -z).
[[nodiscard]] inline Eigen::Vector3d swap_enu_ned(const Eigen::Vector3d& v) { return {v.y(), v.x(), -v.z()}; }

/// Vector in body axes, (forward, port, up) to (forward, starboard, down) or back.
[[nodiscard]] inline Eigen::Vector3d swap_port_starboard(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

/// Body-to-world orientation: both the world's axes and the body's are exchanged.
/// The world's exchange is a half turn about (1, 1, 0), the body's a half turn about x.
[[nodiscard]] inline Eigen::Quaterniond swap_enu_ned(const Eigen::Quaterniond& q) {
  constexpr double kSqrtHalf = 0.70710678118654752440;
  const Eigen::Quaterniond world(0.0, kSqrtHalf, kSqrtHalf, 0.0);
  const Eigen::Quaterniond body(0.0, 1.0, 0.0, 0.0);
  return world * q * body;
}

/// Heading clockwise from true north, pitch positive bow up, roll positive to starboard (all rad) to the orientation
/// in ENU, body x forward, y port, z up. Order: heading, then pitch, then roll, about the body's own axes.
[[nodiscard]] inline Eigen::Quaterniond orientation_from_heading(double heading, double pitch, double roll) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return swap_enu_ned(Eigen::Quaterniond(AngleAxisd(heading, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
                                         AngleAxisd(roll, Vector3d::UnitX())));
}

}  // namespace pelagos
