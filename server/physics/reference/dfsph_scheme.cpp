#include "constraint_sources.hpp"
#include "fluid_stages.hpp"

namespace pelagos {

// Divergence-free SPH (Bender and Koschier 2015, algorithm 1), the paper's reference. Both constraints act on
// velocities: first the density that the step would reach is brought to rest by velocities, with the gradients of the
// old positions; the positions follow; then the velocity at the new positions is made free of divergence. The two
// solves are those of the hybrid scheme (see there for where they differ from the literature).

namespace {

/// Neighbours and gradients at the present positions.
void refresh_all(TaskPool& pool, FluidState& state, Clock clock, StepReport& report) {
  run_stage(report, clock, Stage::kSort, [&] { sort_particles(pool, state); });
  run_stage(report, clock, Stage::kNeighbors, [&] { search_neighbors(pool, state, report); });
  run_stage(report, clock, Stage::kDensity, [&] {
    refresh_density(pool, state, report);
    meet_bodies(pool, state);
  });
}

/// b = delta(x) + dt J v* - 1 at the old positions.
void solve_predicted_density(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  rate_of_density(pool, state, report);
  set_predicted_compression(pool, static_cast<float>(dt), of_particles(state, p.density), state.source);
  const ConstraintProblem problem = make_problem(state, data, warm_factor(state, dt), BodiesIn::kAnswer);
  report.density =
      solve_constraint(pool, problem, state.parameters.density, p.density_pressure, state.work, report.pair_passes);
  report.capped = apply_correction(pool, state, {false, dt});
  push_bodies(state, dt, {true, dt});  // their samples stand where the step would take them without this push
}

}  // namespace

void advance_dfsph(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report) {
  if (!state.gradients_present) {  // settling may have moved particles across a face
    wrap(pool, state);
    refresh_all(pool, state, clock, report);
  }
  run_stage(report, clock, Stage::kPredict, [&] { accelerate(pool, state, dt); });
  run_stage(report, clock, Stage::kDensitySolve, [&] { solve_predicted_density(pool, state, dt, report); });
  run_stage(report, clock, Stage::kPredict, [&] {
    drift(pool, state, dt);
    wrap(pool, state);
  });
  refresh_all(pool, state, clock, report);
  run_stage(report, clock, Stage::kDivergenceSolve, [&] { solve_divergence(pool, state, dt, report); });
  // Bodies still move in this step, and oil may come: the next step then begins with gradients of its own, so that it
  // depends on the state alone.
  state.gradients_present = state.moving_position.empty() && state.oil_count == 0;
}

}  // namespace pelagos
