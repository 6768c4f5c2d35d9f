#include "physics/water_step.hpp"

#include <algorithm>

namespace pelagos {

namespace {

constexpr double kSmallestStep = 0.02;  ///< part of the longest step

}  // namespace

StepReport step_water(TaskPool& pool, FluidState& state, double dt, Clock clock, const WaterStepParts& parts) {
  StepReport report;
  if (parts.place_bodies) parts.place_bodies(report);
  advance_fluid(pool, state, dt, clock, report);
  if (parts.receive_bodies) parts.receive_bodies(report);
  {
    const StageScope scope(report.times, clock, Stage::kAcceleration);
    start_acceleration(pool, state, report);
  }
  if (parts.add_forces) parts.add_forces(report);
  const StageScope scope(report.times, clock, Stage::kMeasure);
  measure_fluid(pool, state, dt, report);
  return report;
}

double choose_time_step(const FluidParameters& parameters, double cfl, double longest, double speed) {
  return std::max(admissible_time_step(parameters, cfl, longest, speed), kSmallestStep * longest);
}

}  // namespace pelagos
