#include "transport/local_plane.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <vector>

namespace pelagos {

struct LocalPlane::Implementation {
  GeographicLib::LocalCartesian plane;
};

LocalPlane::LocalPlane(const GeodeticOrigin& origin)
    : implementation_(std::make_unique<Implementation>(
          Implementation{GeographicLib::LocalCartesian(origin.latitude_deg, origin.longitude_deg, origin.height)})) {}
LocalPlane::~LocalPlane() = default;

BodyPose LocalPlane::to_world(const GeodeticPose& from) const {
  BodyPose pose;
  pose.body = from.body;
  pose.time = from.time;
  std::vector<double> axes(9);  // east, north, up there, in the world's axes; row by row
  implementation_->plane.Forward(from.latitude_deg, from.longitude_deg, from.height, pose.position.x(),
                                 pose.position.y(), pose.position.z(), axes);
  const Eigen::Matrix3d turn = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(axes.data());
  pose.orientation = Eigen::Quaterniond(turn) * from.orientation;
  pose.velocity = turn * from.velocity;
  pose.angular_velocity = turn * from.angular_velocity;
  return pose;
}

}  // namespace pelagos
