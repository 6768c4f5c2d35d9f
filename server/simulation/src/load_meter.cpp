#include "simulation/load_meter.hpp"

#include <algorithm>

namespace pelagos {

void LoadMeter::add(const BodyState& state, const Eigen::Vector3d& impulse, const Eigen::Vector3d& angular_impulse,
                    double dt) {
  const Eigen::Quaterniond back = state.orientation.conjugate();
  impulse_ += back * impulse;
  angular_impulse_ += back * angular_impulse;
  peak_force_ = std::max(peak_force_, impulse.norm() / dt);
  peak_moment_ = std::max(peak_moment_, angular_impulse.norm() / dt);
  time_ += dt;
}

void LoadMeter::take(BodyLoad& load) {
  if (time_ > 0.0) {
    load.force = impulse_ / time_;
    load.moment = angular_impulse_ / time_;
  }
  load.peak_force = peak_force_;
  load.peak_moment = peak_moment_;
  *this = {};
}

}  // namespace pelagos
