#pragma once

#include <functional>

#include "simulation/world.hpp"
#include "water_run.hpp"

namespace pelagos::validation {

/// A whole scene advanced as the server does it, with what it costs.
class WorldRun {
 public:
  WorldRun(int threads, const Scene& scene);

  /// Advances to `time` (s); calls `each` after every step. Throws std::runtime_error where values are not finite.
  void advance_to(double time, const std::function<void(const StepReport&)>& each);
  /// The same by a number of steps.
  void advance_steps(std::int64_t steps, const std::function<void(const StepReport&)>& each);

  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] RunCost cost() const;
  [[nodiscard]] const StageTimes& times() const { return times_; }  ///< of all steps

 private:
  StepReport step();

  World world_;
  StepSums sums_;
  StageTimes times_;
  double wall_s_ = 0;
};

}  // namespace pelagos::validation
