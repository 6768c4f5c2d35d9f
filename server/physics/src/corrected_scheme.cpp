#include <algorithm>
#include <cmath>

#include "constraint_sources.hpp"
#include "fluid_stages.hpp"
#include "held_particles.hpp"
#include "solid_planes.hpp"
#include "vector_kernels.hpp"

namespace pelagos {

// Both of the paper's constraints, in an order in which waves keep their height.
//   repair   x += u with delta(x + u) <= 1, by plain gradients; the velocity stays. Only where the mean compression is
//            above the tolerance. Paper, eq. 21 to 30.
//   solve    v += u / dt with J v <= 0, gravity inside. Particles that are compressed by more than 0.2 % are also
//            driven apart. Paper, eq. 9 to 20.
//   filter   v_i += dt s sqrt(g/d) sum_j V W_ij [v_j - v_i + (G_i + G_j)/2 (x_i - x_j)]
//            This leaves linear velocities as they are and takes out the noise of single particles.
//
// Corrected gradients (Bonet and Lok 1999) make J exact for linear velocities, and J' is its exact adjoint. With plain
// kernel gradients J v is not zero near the surface and in disorder although the flow has no divergence: the constraint
// then stops the wave and turns its energy into noise of the particles.
// The pressure of the velocity solve acts at the positions that the step reaches, so the time integration is symplectic
// for waves. The hybrid's pressure acts at x*, which damps a wave by pi omega dt a period.

namespace {

/// Compression beyond this is not left to the repair alone: the velocity solve takes the share below of it out in a
/// step. Calm water hardly reaches it; without it a breaking dam pressed single particles through sampled walls.
/// Allowing 0.5 % or more let a standing wave 50 layers deep collapse: 4 % of compression that the repair no longer
/// undid.
constexpr float kCompressionAllowed = 0.002F, kCompressionShare = 0.2F;

void repair_positions(TaskPool& pool, FluidState& state, StepReport& report) {
  solve_density(pool, state, 0.0F, BodiesIn::kHold, report);
  if (report.density.iterations == 0) return;
  report.capped = apply_correction(pool, state, {true, 0.0});
  extend_positions(pool, state);
}

/// Density, plain gradients and corrections at the positions before the repair; the velocity solve keeps them: the
/// repair moves particles by hundredths of a spacing.
void refresh_corrections(TaskPool& pool, FluidState& state, StepReport& report) {
  find_solid_planes(pool, state);
  compute_corrections(pool, pair_data(state), state.particles.density, state.gradients, state.corrections);
  leave_held_out(state);
  ++report.pair_passes;
}

void correct_gradients(TaskPool& pool, FluidState& state, StepReport& report) {
  compute_corrected_gradients(pool, pair_data(state), state.corrections, state.gradients);
  ++report.pair_passes;
  leave_held_out(state);
  meet_bodies(pool, state);
}

void solve_velocity(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  rate_of_density(pool, state, report);
  set_divergence_and_excess(pool, static_cast<float>(dt), kCompressionAllowed, kCompressionShare,
                            of_particles(state, p.density), state.source);
  ConstraintProblem problem = make_problem(state, data, warm_factor(state, dt), BodiesIn::kAnswer);
  problem.given = held_pressures(state, dt);
  report.divergence = solve_constraint(pool, problem, state.parameters.divergence, p.divergence_pressure, state.work,
                                       report.pair_passes);
  apply_correction(pool, state, {false, dt});
  push_bodies(state, dt, {false, dt});
}

void filter_velocity(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  const FluidParameters& q = state.parameters;
  state.density_present = q.filter > 0.0;
  if (!state.density_present) return;
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  extend_velocities(pool, state);
  refresh_solid_speeds(pool, state);
  const double rate = std::sqrt(scale_gravity(q.gravity) / q.spacing);
  compute_velocity_gradients(pool, data, state.gradients, state.corrections, p.velocity,
                             static_cast<float>(q.weak_rotation * rate), state.velocity_gradients);
  compute_filter(pool, data, state.velocity_gradients, state.filter_change, p.density);
  report.pair_passes += 2;
  const auto factor = static_cast<float>(std::min(dt * q.filter * rate, kLargestFilterStep));
  keep_held_velocities(state);
  add_scaled_vectors(pool, factor, of_particles(state, state.filter_change.all), p.velocity);
  give_filter_to_bodies(pool, state, factor);
}

}  // namespace

void advance_corrected(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report) {
  run_stage(report, clock, Stage::kPredict, [&] {
    drift(pool, state, dt);
    accelerate(pool, state, dt);
    place_held(state);
    push_out_of_solids(pool, state);
    wrap(pool, state);
  });
  run_stage(report, clock, Stage::kSort, [&] { sort_particles(pool, state); });
  run_stage(report, clock, Stage::kNeighbors, [&] { search_neighbors(pool, state, report); });
  run_stage(report, clock, Stage::kDensity, [&] { refresh_corrections(pool, state, report); });
  run_stage(report, clock, Stage::kDensitySolve, [&] { repair_positions(pool, state, report); });
  run_stage(report, clock, Stage::kCorrectGradients, [&] { correct_gradients(pool, state, report); });
  run_stage(report, clock, Stage::kDivergenceSolve, [&] { solve_velocity(pool, state, dt, report); });
  run_stage(report, clock, Stage::kFilter, [&] { filter_velocity(pool, state, dt, report); });
}

}  // namespace pelagos
