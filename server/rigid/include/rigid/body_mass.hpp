#pragma once

#include <Eigen/Core>

#include "rigid/mass_properties.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// What a body weighs and how its mass lies.
struct BodyMass {
  double mass = 0.0;                                  ///< kg
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< m, body axes: of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m^2, about the centre, along the body's axes

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("mass", self.mass);
    visit("centre", self.centre);
    visit("inertia", self.inertia);
  }
};

/// A body's mass out of its settings; what they leave open is that of a solid of one density in the body's shape.
[[nodiscard]] BodyMass body_mass(const MassSettings& settings, const MassProperties& solid);

}  // namespace pelagos
