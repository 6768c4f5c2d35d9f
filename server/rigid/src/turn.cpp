#include "rigid/turn.hpp"

#include <cmath>

namespace pelagos {

Eigen::Quaterniond rotation_of(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Quaterniond(1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

Eigen::Vector3d turn_of(const Eigen::Quaterniond& rotation) {
  const double sine = rotation.vec().norm();
  if (sine < 1e-12) return 2.0 * (rotation.w() < 0.0 ? -1.0 : 1.0) * rotation.vec();
  const double angle = 2.0 * std::atan2(rotation.w() < 0.0 ? -sine : sine, std::abs(rotation.w()));
  return rotation.vec() * (angle / sine);
}

Eigen::Quaterniond yaw_of(const Eigen::Quaterniond& rotation) {
  const double length = std::hypot(rotation.w(), rotation.z());
  if (length < 1e-9) return Eigen::Quaterniond::Identity();  // upside down: any yaw will do
  return {rotation.w() / length, 0.0, 0.0, rotation.z() / length};
}

}  // namespace pelagos
