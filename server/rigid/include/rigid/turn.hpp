#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pelagos {

/// Rotation by the vector `turn` (axis times angle, rad).
[[nodiscard]] Eigen::Quaterniond rotation_of(const Eigen::Vector3d& turn);

/// The vector (axis times angle, at most pi) of a rotation.
[[nodiscard]] Eigen::Vector3d turn_of(const Eigen::Quaterniond& rotation);

/// Its part about the vertical: what is left after it tilts the vertical only (swing and twist).
[[nodiscard]] Eigen::Quaterniond yaw_of(const Eigen::Quaterniond& rotation);

}  // namespace pelagos
