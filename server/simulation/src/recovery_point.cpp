#include "simulation/recovery_point.hpp"

namespace pelagos {

void RecoveryPoint::keep(const FluidState& fluid, const Bodies& bodies, const FrameClock& clock, double largest_speed) {
  particles_ = fluid.particles;
  last_dt_ = fluid.last_dt;
  bodies_ = bodies.motions();
  clock_ = clock;
  largest_speed_ = largest_speed;
}

void RecoveryPoint::restore(const Eigen::Vector3d& origin, FluidState& fluid, Bodies& bodies, FrameClock& clock,
                            double& largest_speed) const {
  fluid.particles = particles_;
  fluid.last_dt = last_dt_;
  fluid.gradients_present = false;
  fluid.coupling.contacts.clear();
  bodies.restore(bodies_, origin, fluid);
  clock = clock_;
  largest_speed = largest_speed_;
}

}  // namespace pelagos
