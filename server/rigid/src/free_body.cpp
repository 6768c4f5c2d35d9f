#include "rigid/free_body.hpp"

#include <Eigen/LU>

#include "rigid/turn.hpp"

namespace pelagos {

FreeBody::FreeBody(const BodyState& start, const BodyMass& mass, const Freedoms& freedoms)
    : mass_(mass), freedoms_(freedoms), angular_velocity_(start.angular_velocity), orientation_(start.orientation) {
  const Eigen::Vector3d arm = orientation_ * mass_.centre;
  centre_ = start.position + arm;
  velocity_ = start.velocity + angular_velocity_.cross(arm);
}

Eigen::Matrix3d FreeBody::inertia() const {
  const Eigen::Matrix3d rotation = orientation_.toRotationMatrix();
  return rotation * mass_.inertia * rotation.transpose();
}

Eigen::Vector3d FreeBody::inverse_mass() const { return freedoms_.along / mass_.mass; }

Eigen::Matrix3d FreeBody::inverse_inertia() const {
  if (freedoms_.turns_freely()) return inertia().inverse();
  // Rates about axes that are not free do not change, whatever the moment: the others answer alone. The inertia of the
  // former is set to 1 without products, so that the inverse falls apart, and then taken out of it.
  Eigen::Matrix3d inertia_of_free = inertia();
  for (int axis = 0; axis < 3; ++axis) {
    if (freedoms_.about[axis] > 0.0) continue;
    inertia_of_free.row(axis).setZero();
    inertia_of_free.col(axis).setZero();
    inertia_of_free(axis, axis) = 1.0;
  }
  Eigen::Matrix3d inverse = inertia_of_free.inverse();
  for (int axis = 0; axis < 3; ++axis)
    if (freedoms_.about[axis] == 0.0) inverse(axis, axis) = 0.0;
  return inverse;
}

void FreeBody::drift(double dt) {
  const Eigen::Vector3d momentum = angular_momentum();
  centre_ += dt * velocity_;
  orientation_ = (rotation_of(dt * angular_velocity_) * orientation_).normalized();
  if (freedoms_.turns_freely()) angular_velocity_ = inverse_inertia() * momentum;
}

void FreeBody::predict(double dt, double gravity, Order order) {
  if (order == Order::kDriftFirst) drift(dt);
  velocity_.z() -= dt * gravity * freedoms_.along.z();
  if (order == Order::kGravityFirst) drift(dt);
}

void FreeBody::lead(const BodyState& leader) {
  orientation_ = (yaw_of(leader.orientation) * yaw_of(orientation_).conjugate() * orientation_).normalized();
  angular_velocity_.z() = leader.angular_velocity.z();
  const Eigen::Vector3d arm = orientation_ * mass_.centre;
  const Eigen::Vector3d yaw_rate(0.0, 0.0, leader.angular_velocity.z());
  centre_.head<2>() = (leader.position + arm).head<2>();
  velocity_.head<2>() = (leader.velocity + yaw_rate.cross(arm)).head<2>();
}

void FreeBody::take(const Eigen::Vector3d& displacement, const Eigen::Vector3d& turn, const Eigen::Vector3d& velocity,
                    const Eigen::Vector3d& angular_velocity) {
  centre_ += displacement;
  orientation_ = (rotation_of(turn) * orientation_).normalized();
  velocity_ = velocity;
  angular_velocity_ = angular_velocity;
}

void FreeBody::write_to(BodyState& state) const {
  const Eigen::Vector3d arm = orientation_ * mass_.centre;
  state.position = centre_ - arm;
  state.orientation = orientation_;
  state.velocity = velocity_ - angular_velocity_.cross(arm);
  state.angular_velocity = angular_velocity_;
}

}  // namespace pelagos
