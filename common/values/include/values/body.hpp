#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace pelagos {

/// A pose that came from outside (own ship, target), already validated and turned into the world frame (ENU).
struct BodyPose {
  std::uint32_t body = 0;
  double time = 0.0;                                   ///< s, sender's clock; later samples have larger times
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world, unit
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s, world
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< rad/s, world

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("body", self.body);
    visit("time", self.time);
    visit("position", self.position);
    visit("orientation", self.orientation);
    visit("velocity", self.velocity);
    visit("angular_velocity", self.angular_velocity);
  }
};

/// A pose whose place is one on the WGS84 ellipsoid, and whose directions are those of that place: east, north, up.
struct GeodeticPose {
  std::uint32_t body = 0;
  double time = 0.0;                                                ///< s, as in BodyPose
  double latitude_deg = 0.0, longitude_deg = 0.0;                   ///< north and east are positive
  double height = 0.0;                                              ///< m above the ellipsoid
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to east, north, up
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s: east, north, up
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< rad/s about east, north, up
};

/// How fresh the poses of a body are.
enum class PoseHealth : std::uint8_t {
  kNone,      ///< none has arrived yet: the body holds where the scene put it
  kFresh,     ///< the last one is younger than the stale limit
  kCoasting,  ///< stale: the body goes on by dead reckoning
  kHolding,   ///< stale for so long that the body has been stopped
};

/// Where a body is at a frame; published with the water of the same instant.
struct BodyState {
  std::uint32_t body = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m, world
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s, world
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< rad/s, world
  PoseHealth health = PoseHealth::kNone;
  double pose_age = 0.0;  ///< s since the last accepted pose; < 0 if none

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("body", self.body);
    visit("position", self.position);
    visit("orientation", self.orientation);
    visit("velocity", self.velocity);
    visit("angular_velocity", self.angular_velocity);
    visit("health", self.health);
    visit("pose_age", self.pose_age);
  }
};

}  // namespace pelagos
