#include <algorithm>

#include "fluid_stages.hpp"
#include "pressure_kernels.hpp"

namespace pelagos {

// Position-based fluids (Macklin and Mueller 2013): the density constraint on positions alone; the velocity is the
// change of position over the step, so it keeps whatever divergence the corrections leave. Left out of theirs: the
// artificial pressure and vorticity confinement, which are for looks.

namespace {

/// The literal iteration: the constraint is evaluated anew at each corrected position, every correction pushes only,
/// and nothing is carried from step to step.
void iterate_positions(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  FluidParticles& p = state.particles;
  const SolveSettings& settings = state.parameters.density;
  const auto damping = static_cast<float>(settings.jacobi_damping);
  SolveReport& solve = report.density;
  state.work.pressure.resize(p.position.size());
  state.work.displacement.resize(p.position.size());
  for (;;) {
    solve.residual = mean_compression(pool, state);
    solve.converged = solve.residual < settings.tolerance;
    if (solve.converged && solve.iterations >= settings.min_iterations) break;
    if (solve.iterations >= settings.max_iterations) break;
    const PairData data = pair_data(state);
    press_compressed(pool, damping, state.gradients.alpha, of_particles(state, p.density), state.work.pressure);
    if (data.ghosts) extend_scalars(pool, *data.ghosts, state.work.pressure);
    apply_pressure(pool, data, state.gradients, state.work.pressure, state.work.displacement);
    report.capped = std::max(report.capped, apply_correction(pool, state, {true, dt}));
    extend_positions(pool, state);
    refresh_density(pool, state, report);
    report.pair_passes += 1;
    ++solve.iterations;
  }
}

}  // namespace

void advance_pbf(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report) {
  const bool literal = state.parameters.density.method == SolveMethod::kPaper;
  run_stage(report, clock, Stage::kPredict, [&] {
    predict(pool, state, dt);
    wrap(pool, state);
  });
  run_stage(report, clock, Stage::kSort, [&] { sort_particles(pool, state); });
  run_stage(report, clock, Stage::kNeighbors, [&] { search_neighbors(pool, state, report); });
  run_stage(report, clock, Stage::kDensity, [&] {
    refresh_density(pool, state, report);
    meet_bodies(pool, state);
  });
  run_stage(report, clock, Stage::kDensitySolve, [&] {
    if (literal) {
      iterate_positions(pool, state, dt, report);
      return;
    }
    solve_density(pool, state, warm_factor(state, dt), BodiesIn::kAnswer, report);
    const CorrectionTargets targets{true, std::max(dt, state.last_dt / kLargestStepRatio)};
    report.capped = apply_correction(pool, state, targets);
    push_bodies(state, dt, targets);
    extend_positions(pool, state);
  });
  state.density_present = literal;  // theirs is evaluated after every correction
  extend_velocities(pool, state);
}

}  // namespace pelagos
