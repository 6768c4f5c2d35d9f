#include "fluid_stages.hpp"

#include <algorithm>

#include "constraint_sources.hpp"
#include "moving_walls.hpp"
#include "solid_planes.hpp"
#include "solve_passes.hpp"

namespace pelagos {

namespace {

/// A correction never exceeds this share of the spacing.
constexpr double kLargestCorrection = 0.25;

}  // namespace

PairData pair_data(const FluidState& state) {
  PairData data;
  data.count = state.particles.count;
  data.position = state.particles.position.data();
  data.fluid = &state.fluid_list;
  data.boundary = &state.wall_list;
  data.walls = &state.walls;
  data.ghosts = state.ghosts.empty() ? nullptr : &state.ghosts;
  data.walls_move = state.walls_move;
  data.support_radius = static_cast<float>(state.parameters.support_radius);
  data.volume = static_cast<float>(state.parameters.volume());
  data.spacing = static_cast<float>(state.parameters.spacing);
  data.phases = state.oil_count > 0 ? &state.phases : nullptr;
  data.solids = meets_surfaces(state) ? &state.solid_planes : nullptr;
  return data;
}

void accelerate(TaskPool& pool, FluidState& state, double dt) {
  FluidParticles& p = state.particles;
  pool.for_each_range(p.count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    add_scaled(begin, end, static_cast<float>(dt), p.acceleration.data(), p.velocity.data());
  });
}

void drift(TaskPool& pool, FluidState& state, double dt) {
  FluidParticles& p = state.particles;
  pool.for_each_range(p.count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    add_scaled(begin, end, static_cast<float>(dt), p.velocity.data(), p.position.data());
  });
}

void predict(TaskPool& pool, FluidState& state, double dt) {
  FluidParticles& p = state.particles;
  pool.for_each_range(p.count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    add_scaled(begin, end, static_cast<float>(dt), p.acceleration.data(), p.velocity.data());
    add_scaled(begin, end, static_cast<float>(dt), p.velocity.data(), p.position.data());
  });
}

void sort_particles(TaskPool& pool, FluidState& state) {
  FluidParticles& p = state.particles;
  sort_moving_walls(pool, state);
  state.fluid_grid.sort(pool, {p.position.data(), p.count}, state.order);
  permute(pool, state.order, p.position, state.sorted_record);
  permute(pool, state.order, p.velocity, state.sorted_record);
  permute(pool, state.order, p.density_pressure, state.sorted_scalar);
  if (state.parameters.scheme == Scheme::kCorrected)  // the others start this solve cold
    permute(pool, state.order, p.divergence_pressure, state.sorted_scalar);
  permute(pool, state.order, p.id, state.sorted_id);
  if (!p.label.empty()) permute(pool, state.order, p.label, state.sorted_record);
  find_held(state);
  mark_phases(pool, state);
  if (!has_ghosts(state.parameters.edges)) return;
  make_ghosts(pool, state.parameters.patch, state.parameters.edges, static_cast<float>(state.parameters.support_radius),
              p.count, p.position, state.ghosts);
  if (p.velocity.size() < p.position.size()) p.velocity.resize(p.position.size());
  extend_velocities(pool, state);
}

void wrap(TaskPool& pool, FluidState& state) {
  FluidParticles& p = state.particles;
  if (has_ghosts(state.parameters.edges))
    wrap_particles(pool, state.parameters.patch, state.parameters.edges, p.count, p.position, p.velocity);
}

void extend_positions(TaskPool& pool, FluidState& state) {
  if (!state.ghosts.empty()) extend_positions(pool, state.ghosts, state.particles.position);
}

void extend_velocities(TaskPool& pool, FluidState& state) {
  if (!state.ghosts.empty()) extend_vectors(pool, state.ghosts, state.particles.velocity);
}

void search_neighbors(TaskPool& pool, FluidState& state, StepReport& report) {
  const FluidParticles& p = state.particles;
  const std::span<const Float4> query{p.position.data(), p.count};
  const auto radius = static_cast<float>(state.parameters.support_radius);
  const Ghosts& ghosts = state.ghosts;
  const SearchSource fluid[2] = {
      {&state.fluid_grid, p.position.data(), 0},
      {&ghosts.grid, p.position.data() + ghosts.begin, static_cast<std::uint32_t>(ghosts.begin)}};
  const std::size_t fluid_sources = ghosts.empty() ? 1 : 2;
  const SearchReport found = find_neighbors(pool, state.fluid_grid, query, {fluid, fluid_sources}, radius,
                                            static_cast<std::int32_t>(p.count), state.fluid_list);
  report.pairs = found.pairs;
  const SearchSource walls[2] = {{&state.static_grid, state.walls.position.data(), 0},
                                 {&state.moving_grid, state.walls.position.data() + state.static_walls,
                                  static_cast<std::uint32_t>(state.static_walls)}};
  const std::size_t sources = state.moving_position.empty() ? 1 : 2;
  const SearchReport near_walls = find_neighbors(pool, state.fluid_grid, query, {walls, sources}, radius,
                                                 static_cast<std::int32_t>(state.walls.count), state.wall_list);
  report.long_rows = found.long_rows + near_walls.long_rows;
  report.cut_rows = found.cut_rows + near_walls.cut_rows;
}

void refresh_density(TaskPool& pool, FluidState& state, StepReport& report) {
  find_solid_planes(pool, state);
  compute_density(pool, pair_data(state), state.particles.density, state.gradients);
  state.density_present = true;
  ++report.pair_passes;
}

float warm_factor(const FluidState& state, double dt) {
  if (state.last_dt <= 0.0) return 0.0F;
  const double ratio = std::min(dt / state.last_dt, kLargestStepRatio);
  return static_cast<float>(ratio * ratio);
}

ConstraintProblem make_problem(const FluidState& state, const PairData& data, float warm_factor, BodiesIn bodies) {
  ConstraintProblem problem{&data, &state.gradients, state.source, warm_factor};
  problem.held = state.held.rows;
  const std::vector<CoupledBody>& all = state.coupling.bodies;
  const bool any = std::any_of(all.begin(), all.end(), [](const CoupledBody& body) { return body.answers(); });
  if (bodies == BodiesIn::kHold || !any || state.coupling.contacts.empty()) return problem;
  problem.bodies = &state.coupling;
  problem.particle_mass = state.parameters.rest_density * state.parameters.volume();
  return problem;
}

void solve_density(TaskPool& pool, FluidState& state, float warm_factor, BodiesIn bodies, StepReport& report) {
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  set_compression(pool, of_particles(state, p.density), state.source);
  const ConstraintProblem problem = make_problem(state, data, warm_factor, bodies);
  report.density =
      solve_constraint(pool, problem, state.parameters.density, p.density_pressure, state.work, report.pair_passes);
}

std::uint32_t apply_correction(TaskPool& pool, FluidState& state, const CorrectionTargets& targets) {
  FluidParticles& p = state.particles;
  const auto bound = static_cast<float>(kLargestCorrection * state.parameters.spacing);
  const float inverse_span = targets.span > 0.0 ? static_cast<float>(1.0 / targets.span) : 0.0F;
  Float4* position = targets.positions ? p.position.data() : nullptr;
  Float4* velocity = targets.span > 0.0 ? p.velocity.data() : nullptr;
  return sum_blocks(pool, p.count, [&](std::size_t begin, std::size_t end) {
    return apply_displacement(begin, end, bound, inverse_span, state.work.displacement.data(), position, velocity);
  });
}

double mean_compression(TaskPool& pool, const FluidState& state) {
  const FluidParticles& p = state.particles;
  return sum_compression(pool, of_particles(state, p.density)) / static_cast<double>(std::max<std::size_t>(p.count, 1));
}

void rate_of_density(TaskPool& pool, FluidState& state, StepReport& report) {
  const PairData data = pair_data(state);
  extend_velocities(pool, state);
  compute_rate(pool, data, state.gradients, state.particles.velocity, data.walls_move, state.source);
  add_body_velocities(state.coupling, state.source);
  add_floor_speeds(pool, state, state.source);
  ++report.pair_passes;
}

void solve_divergence(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  const SolveSettings& settings = state.parameters.divergence;
  rate_of_density(pool, state, report);
  // Literal: only what closes in is a source (Bender and Koschier 2015).
  const bool clamped = settings.method == SolveMethod::kPaper;
  set_divergence(pool, static_cast<float>(dt), clamped, of_particles(state, state.source));
  const ConstraintProblem problem = make_problem(state, data, 0.0F, BodiesIn::kAnswer);
  report.divergence = solve_constraint(pool, problem, settings, p.divergence_pressure, state.work, report.pair_passes);
  apply_correction(pool, state, {false, dt});
  push_bodies(state, dt, {false, dt});
}

}  // namespace pelagos
