#include "physics/fluid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "fluid_stages.hpp"
#include "physics/boundary.hpp"
#include "sample_images.hpp"
#include "solve_passes.hpp"
#include "vector_kernels.hpp"

namespace pelagos {

namespace {

void place_particles(FluidParticles& p, std::span<const Float4> positions, std::span<const std::uint8_t> phase) {
  p.count = positions.size();
  const std::size_t padded = padded_count(p.count);
  p.position.assign(padded, kFarRecord);
  std::copy(positions.begin(), positions.end(), p.position.begin());
  p.velocity.assign(padded, {});
  p.acceleration.assign(padded, {});
  p.density.assign(padded, 0.0F);
  p.density_pressure.assign(padded, 0.0F);
  p.divergence_pressure.assign(padded, 0.0F);
  p.id.resize(padded);
  for (std::size_t i = 0; i < padded; ++i) p.id[i] = static_cast<std::uint32_t>(i);
  p.phase.assign(phase.begin(), phase.end());
  if (!phase.empty()) p.phase.resize(padded, kWaterPhase);
}

/// Makes these samples the static walls, in cell order.
void sort_static_walls(TaskPool& pool, FluidState& state, std::span<const Float4> samples) {
  state.static_grid.sort(pool, samples, state.order);
  state.static_grid.mark_near_cells();
  BoundaryParticles& walls = state.walls;
  walls.count = state.static_walls = samples.size();
  walls.position.assign(padded_count(walls.count), kFarRecord);
  walls.velocity.assign(padded_count(walls.count), {});
  for (std::size_t k = 0; k < walls.count; ++k) walls.position[k] = samples[state.order[k]];
}

void place_patch_walls(TaskPool& pool, FluidState& state) {
  const FluidParameters& q = state.parameters;
  sort_static_walls(pool, state, sample_patch_walls(pool, q.patch, q.edges, q.spacing, q.support_radius));
}

/// The patch and one support radius around it, more across open edges, where waves carry the water farther out.
Region grid_region(const FluidParameters& parameters) {
  Region region = parameters.patch;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double around = parameters.edges[axis] == Edge::kOpen ? 4.0 : 1.0;
    region.min[axis] -= static_cast<float>(around * parameters.support_radius);
    region.max[axis] += static_cast<float>(around * parameters.support_radius);
  }
  return region;
}

}  // namespace

FluidState make_fluid(TaskPool& pool, const FluidParameters& parameters, std::span<const Float4> positions,
                      std::span<const std::uint8_t> phase) {
  assert(phase.empty() || (parameters.oil && phase.size() == positions.size()));
  FluidState state;
  state.parameters = parameters;
  const Region region = grid_region(parameters);
  state.fluid_grid = state.static_grid = state.moving_grid = state.ghosts.grid =
      CellGrid(region, parameters.support_radius);
  const std::vector<std::uint8_t> all_water(parameters.oil && phase.empty() ? positions.size() : 0, kWaterPhase);
  place_particles(state.particles, positions, phase.empty() ? all_water : phase);
  state.next_id = static_cast<std::uint32_t>(positions.size());
  // At rest gravity is the only acceleration; the first step acts with it.
  std::fill(state.particles.acceleration.begin(), state.particles.acceleration.end(),
            Float4{0.0F, 0.0F, static_cast<float>(-parameters.gravity), 0.0F});
  place_patch_walls(pool, state);
  const std::size_t padded = padded_count(state.particles.count);
  state.source.assign(padded, 0.0F);
  return state;
}

void add_static_walls(TaskPool& pool, FluidState& state, std::span<const Float4> samples) {
  assert(state.moving_position.empty());
  if (samples.empty()) return;
  const auto faces = state.walls.position.begin();
  std::vector<Float4> all(faces, faces + static_cast<std::ptrdiff_t>(state.static_walls));
  const FluidParameters& q = state.parameters;
  for (const PlacedSample& sample : place_with_images(q.patch, q.edges, static_cast<float>(q.support_radius),
                                                      static_cast<float>(q.spacing), samples))
    all.push_back(sample.position);
  sort_static_walls(pool, state, all);
}

void advance_fluid(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report) {
  assert(dt > 0.0);
  report.dt = dt;
  switch (state.parameters.scheme) {
    case Scheme::kHybrid:
      advance_hybrid(pool, state, dt, clock, report);
      break;
    case Scheme::kDfsph:
      advance_dfsph(pool, state, dt, clock, report);
      break;
    case Scheme::kPbf:
      advance_pbf(pool, state, dt, clock, report);
      break;
    case Scheme::kCorrected:
      advance_corrected(pool, state, dt, clock, report);
      break;
  }
  state.last_dt = dt;
}

namespace {

/// Largest nu dt / d^2 of an explicit step: twice as much is unstable.
constexpr double kExplicitViscosity = 0.1;

double usual_longest_step(const FluidParameters& q) { return usual_step(q.spacing, scale_gravity(q.gravity)); }

/// Of one phase or of a pair, on the lighter partner; m^2/s.
double largest_viscosity(const PhasePair& pair) {
  return static_cast<double>(
      std::max({pair.light_mobility * pair.light_viscosity, pair.heavy_mobility * pair.heavy_viscosity,
                pair.light_mobility * pair.mixed_viscosity}));
}

void set_gravity(TaskPool& pool, FluidState& state) {
  const Float4 gravity{0.0F, 0.0F, static_cast<float>(-state.parameters.gravity), 0.0F};
  fill_vectors(pool, gravity, of_particles(state, state.particles.acceleration));
}

/// Two phases: gravity and viscosity, explicit or implicit; densities where they are open.
void start_phase_acceleration(TaskPool& pool, FluidState& state, StepReport& report) {
  FluidParticles& p = state.particles;
  const FluidParameters& q = state.parameters;
  const double viscosity = largest_viscosity(state.phases);
  const double dt = std::max(state.last_dt, usual_longest_step(q));
  const bool implicit = viscosity * dt > kExplicitViscosity * q.spacing * q.spacing;
  const bool explicitly = viscosity > 0.0 && !implicit;
  extend_velocities(pool, state);
  if (explicitly || !state.density_present) {
    compute_phase_acceleration(pool, pair_data(state), p.velocity, static_cast<float>(q.gravity), p.acceleration,
                               state.density_present ? std::span<float>{} : std::span<float>(p.density));
    state.density_present = true;
    ++report.pair_passes;
  }
  if (!explicitly) set_gravity(pool, state);
  if (!implicit || !(state.last_dt > 0.0)) return;
  solve_viscosity(pool, state, state.last_dt, report);
  extend_velocities(pool, state);
}

}  // namespace

void start_acceleration(TaskPool& pool, FluidState& state, StepReport& report) {
  const FluidParameters& q = state.parameters;
  if (!state.density_present && meets_surfaces(state)) refresh_density(pool, state, report);
  if (state.oil_count > 0) {
    start_phase_acceleration(pool, state, report);
    return;
  }
  if (!(q.viscosity > 0.0) && state.density_present) {
    set_gravity(pool, state);
    return;
  }
  extend_velocities(pool, state);
  compute_acceleration(pool, pair_data(state), state.particles.velocity, static_cast<float>(q.viscosity),
                       static_cast<float>(q.gravity), state.particles.acceleration,
                       state.density_present ? std::span<float>{} : std::span<float>(state.particles.density));
  state.density_present = true;
  ++report.pair_passes;
}

namespace {

/// Bounds that a particle has left the patch beyond. Mirrors and periodic faces have none: what a correction has moved
/// beyond them is put back at the start of the next step.
void set_bounds(const FluidParameters& parameters, StateArrays& arrays) {
  constexpr float kAnywhere = std::numeric_limits<float>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool wall = parameters.edges[axis] == Edge::kWall;
    arrays.min[axis] = wall ? parameters.patch.min[axis] : -kAnywhere;
    arrays.max[axis] = wall ? parameters.patch.max[axis] : kAnywhere;
  }
}

}  // namespace

void measure_fluid(TaskPool& pool, const FluidState& state, double dt, StepReport& report) {
  const FluidParticles& p = state.particles;
  StateArrays arrays{p.position.data(), p.velocity.data(), p.acceleration.data(), p.density.data(), {}, {}};
  if (!p.phase.empty()) {
    arrays.phase = p.phase.data();
    arrays.oil_mass = static_cast<float>(state.parameters.oil->rest_density / state.parameters.rest_density);
  }
  set_bounds(state.parameters, arrays);
  std::vector<StateSums> partial((p.count + kPointBlock - 1) / kPointBlock);
  pool.for_each_range(p.count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    partial[begin / kPointBlock] = measure_state(begin, end, arrays, static_cast<float>(dt));
  });
  double speed_squared = 0, height = 0, compression = 0;
  float fastest = 0;
  report.largest_density = 0;
  report.outside = report.not_finite = 0;
  for (const StateSums& sums : partial) {
    speed_squared += static_cast<double>(sums.speed_squared);
    height += static_cast<double>(sums.height);
    compression += static_cast<double>(sums.compression);
    fastest = std::max(fastest, sums.largest_speed_squared);
    report.largest_density = std::max(report.largest_density, static_cast<double>(sums.largest_density));
    report.outside += sums.outside;
    report.not_finite += sums.not_finite;
  }
  const double mass = state.parameters.rest_density * state.parameters.volume();
  report.kinetic_energy = 0.5 * mass * speed_squared;
  report.potential_energy = mass * state.parameters.gravity * height;
  report.density_error = compression / static_cast<double>(std::max<std::size_t>(p.count, 1));
  report.largest_speed = std::sqrt(static_cast<double>(fastest));
}

double admissible_time_step(const FluidParameters& parameters, double cfl, double max_step, double largest_speed) {
  if (!(largest_speed > 0.0)) return max_step;
  return std::min(max_step, cfl * parameters.spacing / largest_speed);
}

std::uint64_t state_hash(const FluidParticles& particles) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int byte = 0; byte < 4; ++byte) hash = (hash ^ ((bits >> (8 * byte)) & 0xFFU)) * 1099511628211ULL;
  };
  for (std::size_t i = 0; i < particles.count; ++i)
    for (const Float4* record : {&particles.position[i], &particles.velocity[i]}) {
      add(record->x);
      add(record->y);
      add(record->z);
    }
  return hash;
}

}  // namespace pelagos
