#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

#include "values/body.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// The world's tangent plane at a place on the WGS84 ellipsoid, by GeographicLib.
class LocalPlane {
 public:
  explicit LocalPlane(const GeodeticOrigin& origin);
  ~LocalPlane();
  LocalPlane(const LocalPlane&) = delete;
  LocalPlane& operator=(const LocalPlane&) = delete;

  /// The pose in world axes. Directions turn too: north, 50 km east of the origin, is not the world's.
  [[nodiscard]] BodyPose to_world(const GeodeticPose& pose) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
