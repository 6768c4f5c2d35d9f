#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "rigid/body_shape.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// A body where the scene puts it. Both pointers belong to a Bodies.
struct PlacedShape {
  const BodySettings* settings = nullptr;
  const BodyShape* shape = nullptr;

  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& x) const {
    return settings->orientation * x + settings->position;
  }
  [[nodiscard]] Eigen::Vector3d to_body(const Eigen::Vector3d& x) const {
    return settings->orientation.conjugate() * (x - settings->position);
  }
  /// The box around it, m, world axes.
  [[nodiscard]] Eigen::AlignedBox3d place() const {
    Eigen::AlignedBox3d box;
    for (int corner = 0; corner < 8; ++corner)
      box.extend(to_world(shape->bounding_box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))));
    return box;
  }
  /// As messages name it: "body 3 (quay)".
  [[nodiscard]] std::string name() const {
    return "body " + std::to_string(settings->id) + " (" + settings->name + ")";
  }
};

}  // namespace pelagos
