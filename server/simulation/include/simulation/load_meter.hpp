#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "values/body.hpp"
#include "values/body_load.hpp"

namespace pelagos {

/// Averages what the water does to a body over the steps of a frame. A single step's force is 2 to 4 % noise.
class LoadMeter {
 public:
  /// A step of `dt` (s): the water's impulse and angular impulse about `point`, world axes, on a body that stands as
  /// `state` says.
  void add(const BodyState& state, const Eigen::Vector3d& impulse, const Eigen::Vector3d& angular_impulse, double dt);

  /// The mean since the last call, and its peaks, into `load`; then starts anew. Zero where no step was made.
  void take(BodyLoad& load);

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("time", self.time_);
    visit("impulse", self.impulse_);
    visit("angular_impulse", self.angular_impulse_);
    visit("peak_force", self.peak_force_);
    visit("peak_moment", self.peak_moment_);
  }

 private:
  double time_ = 0.0;
  Eigen::Vector3d impulse_ = Eigen::Vector3d::Zero(), angular_impulse_ = Eigen::Vector3d::Zero();  ///< body axes
  double peak_force_ = 0.0, peak_moment_ = 0.0;
};

}  // namespace pelagos
