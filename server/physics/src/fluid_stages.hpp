#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "particle_blocks.hpp"
#include "physics/fluid.hpp"

namespace pelagos {

// The stages that schemes share, in the order in which they usually come.

/// v += dt a
void accelerate(TaskPool& pool, FluidState& state, double dt);
/// x += dt v
void drift(TaskPool& pool, FluidState& state, double dt);
/// v* = v + dt a;  x* = x + dt v*
void predict(TaskPool& pool, FluidState& state, double dt);
/// Brings particles that have crossed mirrored or periodic faces back. Nothing without such faces.
void wrap(TaskPool& pool, FluidState& state);
/// Sorts the particles and the moving samples by cell at their present positions, and makes the images that mirrored
/// and periodic faces need, of positions and velocities.
void sort_particles(TaskPool& pool, FluidState& state);
/// Marks phases in position.w and fills state.phases, in the present order; before images are made. Nothing without
/// oil.
void mark_phases(TaskPool& pool, FluidState& state);
/// Brings the images of positions up to date, and of velocities. Nothing without images.
void extend_positions(TaskPool& pool, FluidState& state);
void extend_velocities(TaskPool& pool, FluidState& state);
/// Neighbour lists at the present positions.
void search_neighbors(TaskPool& pool, FluidState& state, StepReport& report);
/// Density and plain gradients at the present positions.
void refresh_density(TaskPool& pool, FluidState& state, StepReport& report);
/// The view that pair passes read.
[[nodiscard]] PairData pair_data(const FluidState& state);

/// The entries of the particles, without the padding.
template <class T>
std::span<T> of_particles(const FluidState& state, std::vector<T>& values) {
  return {values.data(), state.particles.count};
}
template <class T>
std::span<const T> of_particles(const FluidState& state, const std::vector<T>& values) {
  return {values.data(), state.particles.count};
}

/// (dt / last dt)^2, the factor on carried pressures; 0 before the first step. Pressures follow dt^2, but the repair of
/// density in them does not: after a sliver of a step it would be blown up, so the ratio is bounded.
[[nodiscard]] float warm_factor(const FluidState& state, double dt);
/// Density constraint on the present positions: source = delta - 1; work.displacement holds the corrections.
enum class BodiesIn {
  kHold,    ///< bodies stay where they are
  kAnswer,  ///< bodies move with the pressure
};
void solve_density(TaskPool& pool, FluidState& state, float warm_factor, BodiesIn bodies, StepReport& report);
/// A constraint with state.source as it is.
[[nodiscard]] ConstraintProblem make_problem(const FluidState& state, const PairData& data, float warm_factor,
                                             BodiesIn bodies);
/// x += u and v += u / span with |u| <= d/4 for each particle; either target may be left out. Returns how many
/// corrections were bounded: a leaking column would blow up otherwise.
struct CorrectionTargets {
  bool positions = false;
  double span = 0.0;  ///< s; 0: velocities stay
};
std::uint32_t apply_correction(TaskPool& pool, FluidState& state, const CorrectionTargets& targets);
/// Contacts of the bodies at the present lists, with the present gradients, and an alpha that is small enough for
/// bodies that answer: half their rows' sum is added to its inverse, for the diagonal alone is too little for light
/// ones. Nothing without bodies.
void meet_bodies(TaskPool& pool, FluidState& state);
/// rate -= what the bodies' present velocities do to the density.
void add_body_velocities(const BodyCoupling& coupling, std::span<float> rate);
/// Lets the bodies take what the last solve gave them over a step of dt; targets as for the water.
void push_bodies(FluidState& state, double dt, const CorrectionTargets& targets);
/// Mean of max(delta - 1, 0) over the particles.
[[nodiscard]] double mean_compression(TaskPool& pool, const FluidState& state);
/// source = J v of the present velocities, the walls' own included, 1/s.
void rate_of_density(TaskPool& pool, FluidState& state, StepReport& report);
/// A velocity without divergence: source = dt J v, cold.
void solve_divergence(TaskPool& pool, FluidState& state, double dt, StepReport& report);

/// Viscosity by an implicit step of dt on the velocities, see start_acceleration; two phases. Momentum is conserved to
/// rounding whatever the tolerance.
void solve_viscosity(TaskPool& pool, FluidState& state, double dt, StepReport& report);

void advance_hybrid(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report);
void advance_dfsph(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report);
void advance_pbf(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report);
void advance_corrected(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report);

/// Runs a stage under its name in the profile.
template <class F>
void run_stage(StepReport& report, Clock clock, Stage stage, F&& f) {
  const StageScope scope(report.times, clock, stage);
  f();
}

/// The filter's explicit step is stable up to about 1; it never takes more than this share of the noise at once.
inline constexpr double kLargestFilterStep = 0.5;

/// After a step that was cut short, corrections act as a velocity over no less than the last step by this ratio.
inline constexpr double kLargestStepRatio = 2.0;

/// values[k] = values[order[k]], the padding left as it is.
template <class T>
void permute(TaskPool& pool, std::span<const std::uint32_t> order, std::vector<T>& values, std::vector<T>& scratch) {
  if (scratch.size() < values.size()) scratch.resize(values.size());
  const std::size_t padded = padded_count(order.size());
  pool.for_each_range(order.size(), kPointBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) scratch[k] = values[order[k]];
  });
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(order.size()),
            values.begin() + static_cast<std::ptrdiff_t>(padded),
            scratch.begin() + static_cast<std::ptrdiff_t>(order.size()));
  values.swap(scratch);
}

}  // namespace pelagos
