#include "simulation/body_drift.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

constexpr double kMeanPerRelaxation = 0.5, kPullPerRelaxation = 0.25, kKnownPerRelaxation = 2.0;
constexpr double kWholeSpeed = 0.1;  ///< m/s: a current from which on the force is whole

}  // namespace

DriftForce BodyDrift::act(const DriftSea& sea, const DriftingHull& hull, double dt) {
  const Eigen::Vector2d push = hull.push.head<2>();
  const double part = -std::expm1(-dt / (kMeanPerRelaxation * sea.relaxation));
  push_ += part * (push - push_);
  water_ += part * (sea.water - water_);
  weight_ += part * (1.0 - weight_);
  unknown_ *= std::exp(-dt / (kKnownPerRelaxation * sea.relaxation));

  const double speed = sea.current.norm(), known = (1.0 - unknown_) * (1.0 - unknown_);
  const double carried = hull.weight > 0.0 ? std::clamp(hull.push.z() / hull.weight, 0.0, 1.0) : 0.0;
  Eigen::Vector2d lag = sea.current + water_ / weight_ - hull.velocity;
  if (lag.norm() > speed) lag *= speed / lag.norm();
  const Eigen::Vector2d pull = carried * hull.mass * (sea.rate + lag / (kPullPerRelaxation * sea.relaxation));
  const Eigen::Vector2d drag = push - known * (push - push_ / weight_);
  DriftForce force;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (!sea.acts[static_cast<std::size_t>(axis)]) continue;
    const double whole = std::min(speed / kWholeSpeed, 1.0);
    force.on_body[axis] = whole * (pull[axis] - drag[axis]);
    force.on_water[axis] = whole * drag[axis];
  }
  return force;
}

}  // namespace pelagos
