#include "rigid/driven_body.hpp"

#include <algorithm>
#include <cmath>

#include "rigid/turn.hpp"

namespace pelagos {

namespace {

constexpr double kClockJump = 1.0;     ///< s: a larger change of the clocks' difference is a restart
constexpr double kClockSeconds = 2.0;  ///< s: how fast the difference follows later arrivals

/// Error and its rate after `dt` of critical damping.
struct Damped {
  Eigen::Vector3d error, rate;
};
Damped damp(const Eigen::Vector3d& error, const Eigen::Vector3d& rate, double w, double dt) {
  const Eigen::Vector3d slope = rate + w * error;
  const double decay = std::exp(-w * dt);
  return {decay * (error + slope * dt), decay * (rate - w * dt * slope)};
}

/// How far a motion goes on that runs at full speed until `full` and then dies out over `fading`, and its speed.
struct Faded {
  double way, speed;
};
Faded fade_out(double time, double full, double fading) {
  if (time <= full) return {time, 1.0};
  const double speed = std::exp(-(time - full) / fading);
  return {full + fading * (1.0 - speed), speed};
}

}  // namespace

DrivenBody::DrivenBody(const BodyState& start, double spacing, double reach, const DrivenBodySettings& settings)
    : settings_(settings), spacing_(spacing), reach_(reach), state_(start) {
  state_.velocity.setZero();
  state_.angular_velocity.setZero();
  state_.health = PoseHealth::kNone;
  state_.pose_age = -1.0;
}

bool DrivenBody::accept(const BodyPose& pose, double now) {
  if (has_pose_ && pose.time <= pose_.time && pose.time > pose_.time - kClockJump) return false;
  const double offset = now - pose.time;
  if (!has_pose_ || std::abs(offset - clock_offset_) > kClockJump || offset <= clock_offset_) {
    clock_offset_ = offset;
  } else {
    clock_offset_ += (offset - clock_offset_) * (1.0 - std::exp(-(now - arrival_) / kClockSeconds));
  }
  pose_ = pose;
  pose_.orientation.normalize();
  arrival_ = now;
  has_pose_ = true;
  return true;
}

DrivenBody::Target DrivenBody::target_at(double time) const {
  // Times of the fading laws count from the arrival; the way before it is the delay of the pose.
  const double delay = arrival_ - (pose_.time + clock_offset_);
  const double since = time - arrival_;
  const Faded course = fade_out(since, settings_.holding_limit, settings_.stopping_time);
  const Faded attitude = fade_out(since, settings_.fresh_limit, settings_.fresh_limit);
  const Eigen::Vector3d yaw(0.0, 0.0, pose_.angular_velocity.z());
  const Eigen::Vector3d roll_and_pitch(pose_.angular_velocity.x(), pose_.angular_velocity.y(), 0.0);
  Target target;
  target.position = pose_.position + pose_.velocity * (delay + course.way);
  target.velocity = pose_.velocity * course.speed;
  target.orientation =
      (rotation_of(yaw * (delay + course.way) + roll_and_pitch * (delay + attitude.way)) * pose_.orientation)
          .normalized();
  target.angular_velocity = yaw * course.speed + roll_and_pitch * attitude.speed;
  return target;
}

BodyState DrivenBody::advance(double dt, double now) {
  if (!has_pose_) return state_;
  const Target before = target_at(now), after = target_at(now + dt);
  const Eigen::Vector3d error = state_.position - before.position;
  const Eigen::Vector3d turn = turn_of(state_.orientation * before.orientation.conjugate());
  if (std::max(error.norm(), turn.norm() * reach_) > settings_.jump_distance * spacing_) {
    ++jumps_;
    state_.position = after.position;
    state_.orientation = after.orientation;
    velocity_ = after.velocity;
    angular_velocity_ = after.angular_velocity;
  } else {
    const double w = settings_.tracking_rate;
    const Damped way = damp(error, velocity_ - before.velocity, w, dt);
    const Damped rotation = damp(turn, angular_velocity_ - before.angular_velocity, w, dt);
    state_.position = after.position + way.error;
    state_.orientation = (rotation_of(rotation.error) * after.orientation).normalized();
    velocity_ = after.velocity + way.rate;
    angular_velocity_ = after.angular_velocity + rotation.rate;
  }
  state_.pose_age = now + dt - arrival_;
  state_.health = state_.pose_age < settings_.fresh_limit     ? PoseHealth::kFresh
                  : state_.pose_age < settings_.holding_limit ? PoseHealth::kCoasting
                                                              : PoseHealth::kHolding;
  cap_velocities(dt);
  return state_;
}

void DrivenBody::cap_velocities(double dt) {
  state_.velocity = velocity_;
  state_.angular_velocity = angular_velocity_;
  const double fastest = velocity_.norm() + angular_velocity_.norm() * reach_;
  const double cap = dt > 0.0 ? settings_.speed_cap * spacing_ / dt : fastest;
  if (fastest > cap) {
    state_.velocity *= cap / fastest;
    state_.angular_velocity *= cap / fastest;
  }
}

}  // namespace pelagos
