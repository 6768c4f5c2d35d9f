#include "world_run.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "monotonic_clock.hpp"

namespace pelagos::validation {

WorldRun::WorldRun(int threads, const Scene& scene) : world_(scene, {threads, nullptr, {}}) {}

StepReport WorldRun::step() {
  const std::int64_t begin = monotonic_ns();
  const WorldStep step = world_.advance();
  sums_.wall_s += 1e-9 * static_cast<double>(monotonic_ns() - begin);
  if (step.fault != StepFault::kNone)
    throw std::runtime_error("values are not finite at " + std::to_string(world_.time()) + " s");
  const StepReport& report = step.report;
  ++sums_.steps;
  sums_.density_iterations += report.density.iterations;
  sums_.velocity_iterations += report.divergence.iterations;
  sums_.density_error += report.density_error;
  sums_.density_error_peak = std::max(sums_.density_error_peak, report.density_error);
  sums_.largest_density = std::max(sums_.largest_density, report.largest_density);
  sums_.unconverged_steps += report.density.converged && report.divergence.converged ? 0 : 1;
  return report;
}

void WorldRun::advance_to(double time, const std::function<void(const StepReport&)>& each) {
  while (world_.time() < time) each(step());
}

void WorldRun::advance_steps(std::int64_t steps, const std::function<void(const StepReport&)>& each) {
  for (std::int64_t k = 0; k < steps; ++k) each(step());
}

RunCost WorldRun::cost() const {
  RunCost cost = sums_;
  cost.particles = world_.fluid().particles.count;
  cost.simulated_s = world_.time();
  for (double* sum : {&cost.density_iterations, &cost.velocity_iterations, &cost.density_error})
    *sum /= static_cast<double>(std::max<std::int64_t>(cost.steps, 1));
  return cost;
}

}  // namespace pelagos::validation
