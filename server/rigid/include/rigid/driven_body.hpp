#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "values/body.hpp"

namespace pelagos {

struct DrivenBodySettings {
  double tracking_rate = 6.0;  ///< 1/s, 4 to 8: how fast the error to the pose stream dies out
  double fresh_limit = 0.5;    ///< s since the last pose: older is stale, the body coasts
  double holding_limit = 3.0;  ///< s since the last pose: from here on the body is brought to rest
  double stopping_time = 1.0;  ///< s, 1/e of the way to rest
  double jump_distance = 5.0;  ///< spacings: a larger error is a teleport, not a motion
  double speed_cap = 0.4;      ///< spacings per time step that the body may show to the water

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("tracking_rate", self.tracking_rate);
    visit("fresh_limit", self.fresh_limit);
    visit("holding_limit", self.holding_limit);
    visit("stopping_time", self.stopping_time);
    visit("jump_distance", self.jump_distance);
    visit("speed_cap", self.speed_cap);
  }
};

/// A body that follows poses received from outside.
///
/// Between poses the last one is carried on with its velocities (dead reckoning). The body moves with the velocity of
/// that reckoned pose, and what error remains dies out critically damped, so there is no steady lag and a jittering
/// stream makes no jets:  e'' + 2 w e' + w^2 e = 0, solved exactly over each step, stable for any step.
///
/// The sender's clock is mapped to simulation time by the arrival of the poses: the least delayed ones set the
/// difference of the clocks, which follows later ones slowly (within 2 s); a difference that jumps by more than a
/// second (the sender restarted, the simulation was paused) is taken as it is.
///
/// Without poses: fresh for 0.5 s, then coasting, from 3 s on brought smoothly to rest and held. Roll and pitch rates
/// fade from the end of the fresh time on, for a hull that kept its last roll rate for seconds would capsize.
///
/// Teleports: where the error exceeds `jump_distance` spacings (of position, or of the farthest sample through
/// rotation), the body jumps to the reckoned pose at once. Whatever happens, the velocities handed out are scaled down
/// so that no sample moves faster than `speed_cap` spacings a step.
class DrivenBody {
 public:
  DrivenBody() = default;  ///< to be read into
  /// @param start    where the scene puts the body; its velocities are ignored
  /// @param spacing  particle spacing, m
  /// @param reach    distance of the farthest sample from the body's origin, m
  DrivenBody(const BodyState& start, double spacing, double reach, const DrivenBodySettings& settings = {});

  /// Takes a pose that arrived at simulation time `now` (s). False where it is not newer than the last one: out of
  /// order, ignored. A sender whose clock went back by more than a second has restarted and is believed.
  bool accept(const BodyPose& pose, double now);

  /// Moves the body from `now` to `now + dt` (s, dt >= 0) and returns its state there.
  BodyState advance(double dt, double now);

  [[nodiscard]] const BodyState& state() const { return state_; }
  /// How often the body has jumped so far. After a step in which it did, water may be inside the body.
  [[nodiscard]] std::uint64_t jumps() const { return jumps_; }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("settings", self.settings_);
    visit("spacing", self.spacing_);
    visit("reach", self.reach_);
    visit("state", self.state_);
    visit("velocity", self.velocity_);
    visit("angular_velocity", self.angular_velocity_);
    visit("has_pose", self.has_pose_);
    visit("pose", self.pose_);
    visit("arrival", self.arrival_);
    visit("clock_offset", self.clock_offset_);
    visit("jumps", self.jumps_);
  }

 private:
  /// Where the pose stream puts the body.
  struct Target {
    Eigen::Vector3d position, velocity, angular_velocity;
    Eigen::Quaterniond orientation;
  };
  [[nodiscard]] Target target_at(double time) const;
  void cap_velocities(double dt);

  DrivenBodySettings settings_;
  double spacing_ = 0.0, reach_ = 0.0;
  BodyState state_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();          ///< before the cap
  Eigen::Vector3d angular_velocity_ = Eigen::Vector3d::Zero();  ///< before the cap
  bool has_pose_ = false;
  BodyPose pose_;              ///< the last one
  double arrival_ = 0.0;       ///< s, simulation time of its arrival
  double clock_offset_ = 0.0;  ///< s, simulation time minus sender's time
  std::uint64_t jumps_ = 0;
};

}  // namespace pelagos
