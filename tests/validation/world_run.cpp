#include "world_run.hpp"

#include <stdexcept>
#include <string>

#include "monotonic_clock.hpp"

namespace pelagos::validation {

WorldRun::WorldRun(int threads, const Scene& scene) : world_(scene, {threads, monotonic_ns, {}}) {}

StepReport WorldRun::step() {
  const std::int64_t begin = monotonic_ns();
  const WorldStep step = world_.advance();
  wall_s_ += 1e-9 * static_cast<double>(monotonic_ns() - begin);
  if (step.fault != StepFault::kNone)
    throw std::runtime_error("values are not finite at " + std::to_string(world_.time()) + " s");
  sums_.add(step.report);
  for (std::size_t k = 0; k < kStageCount; ++k) times_.ns[k] += step.report.times.ns[k];
  return step.report;
}

void WorldRun::advance_to(double time, const std::function<void(const StepReport&)>& each) {
  while (world_.time() < time) each(step());
}

void WorldRun::advance_steps(std::int64_t steps, const std::function<void(const StepReport&)>& each) {
  for (std::int64_t k = 0; k < steps; ++k) each(step());
}

RunCost WorldRun::cost() const { return run_cost(sums_, world_.fluid().particles.count, wall_s_); }

}  // namespace pelagos::validation
