#pragma once

#include <functional>

#include "physics/fluid.hpp"

namespace pelagos {

/// What acts on the water in a step beside its own pressure, viscosity and gravity. Each may be empty.
struct WaterStepParts {
  std::function<void(StepReport&)> place_bodies;    ///< before the water moves
  std::function<void(StepReport&)> receive_bodies;  ///< after the solves, with the water's push on them
  std::function<void(StepReport&)> add_forces;      ///< into particles.acceleration, of the next step
};

/// One step of water: the only one there is, for seas, benchmarks, accuracy cases and tests.
/// @param dt  s, > 0; see choose_time_step
[[nodiscard]] StepReport step_water(TaskPool& pool, FluidState& state, double dt, Clock clock = nullptr,
                                    const WaterStepParts& parts = {});

/// The step to make: the largest admissible one, but no less than a fiftieth of the longest. One runaway particle must
/// not stop the clock.
/// @param cfl  largest part of a spacing that a particle may move  @param longest  s  @param speed  m/s, the largest
[[nodiscard]] double choose_time_step(const FluidParameters& parameters, double cfl, double longest, double speed);

}  // namespace pelagos
