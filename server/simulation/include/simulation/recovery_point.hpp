#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/fluid.hpp"
#include "simulation/bodies.hpp"
#include "simulation/frame_clock.hpp"

namespace pelagos {

/// The last good state of a world: water, bodies and time. The wind is not part of it: it blows on as it is set.
class RecoveryPoint {
 public:
  explicit RecoveryPoint(const FrameClock& clock) : clock_(clock) {}

  void keep(const FluidState& fluid, const Bodies& bodies, const FrameClock& clock, double largest_speed);

  /// Puts everything back, bit by bit. What a step derives from it (lists, gradients) is made anew by the next one.
  void restore(const Eigen::Vector3d& origin, FluidState& fluid, Bodies& bodies, FrameClock& clock,
               double& largest_speed) const;

 private:
  FluidParticles particles_;
  double last_dt_ = 0.0;
  std::vector<Bodies::Motion> bodies_;
  FrameClock clock_;
  double largest_speed_ = 0.0;
};

}  // namespace pelagos
