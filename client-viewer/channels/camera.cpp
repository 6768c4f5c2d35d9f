#include "channels/camera.hpp"

#include <cmath>

#include "scales/angles.hpp"

namespace pelagos {
namespace {

/// Turn in the body axes (x forward, y port, z up): first pitch about the port axis, then yaw about the up axis.
Eigen::Matrix3d turn(double yaw_to_starboard_deg, double pitch_up_deg) {
  return (Eigen::AngleAxisd(-yaw_to_starboard_deg * kRadiansPerDegree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(-pitch_up_deg * kRadiansPerDegree, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

}  // namespace

double heading_of(const Eigen::Quaterniond& orientation) {
  const Eigen::Vector3d forward = orientation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

BodyState extrapolate(const BodyState& body, double seconds) {
  BodyState later = body;
  later.position += seconds * body.velocity;
  const Eigen::Vector3d angle = seconds * body.angular_velocity;
  if (angle.norm() > 1e-12)
    later.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle.norm(), angle.normalized())) * body.orientation;
  return later;
}

std::optional<Camera> camera_for(const Channel& channel, std::span<const BodyState> bodies, int width, int height) {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d world_from_mount = Eigen::Matrix3d::Identity();
  if (channel.mount.body != 0) {
    const BodyState* body = nullptr;
    for (const BodyState& candidate : bodies)
      if (candidate.body == channel.mount.body) body = &candidate;
    if (body == nullptr) return std::nullopt;
    origin = body->position;
    if (channel.mount.attitude == MountAttitude::kFull)
      world_from_mount = body->orientation.toRotationMatrix();
    else if (channel.mount.attitude == MountAttitude::kHeading)
      world_from_mount = Eigen::AngleAxisd(heading_of(body->orientation), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (channel.mount.attitude != MountAttitude::kFull) origin.z() = 0.0;
  } else {
    // heading is degrees clockwise from north; the mount's x axis looks that way
    world_from_mount = turn(channel.mount.heading_deg - 90.0, 0.0);
  }
  // The rig is tilted as a whole; the channels turn about its own up axis, so that seams meet.
  const Eigen::Matrix3d world_from_rig = world_from_mount * turn(0.0, channel.mount.tilt_deg);
  const Eigen::Matrix3d axes = world_from_rig * turn(channel.yaw_deg, channel.pitch_deg);  // forward, port, up

  Camera camera;
  camera.eye = origin + world_from_mount * channel.mount.eye;
  camera.view_from_world.row(0) = -axes.col(1).transpose();
  camera.view_from_world.row(1) = axes.col(2).transpose();
  camera.view_from_world.row(2) = axes.col(0).transpose();
  camera.tan_half_x = std::tan(0.5 * channel.horizontal_fov_deg * kRadiansPerDegree);
  camera.tan_half_y = camera.tan_half_x * height / width;
  camera.width = width;
  camera.height = height;
  camera.guard = channel.guard_px;
  return camera;
}

}  // namespace pelagos
