#include "water_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "monotonic_clock.hpp"
#include "simulation/deep_water.hpp"
#include "simulation/fluid_setup.hpp"
#include "solver_names.hpp"

namespace pelagos::validation {

namespace {

/// Explicit viscosity is stable up to nu dt / d^2 of about twice this.
constexpr double kViscousStep = 0.1;

double layers_of(const FluidParameters& parameters, const Start& start) {
  if (start.positions.empty() || !(parameters.gravity > 0.0)) return 0.0;
  const auto [low, high] = std::minmax_element(start.positions.begin(), start.positions.end(),
                                               [](const Float4& a, const Float4& b) { return a.z < b.z; });
  return static_cast<double>(high->z - low->z) / parameters.spacing + 1.0;
}

FluidParameters with_solver(FluidParameters parameters, const SolverChoice& choice, double layers) {
  SolverSettings solver;
  if (!choose_solver(choice.name, solver)) throw std::invalid_argument("no solver of the name " + choice.name);
  if (choice.tolerance > 0.0) solver.density.tolerance = solver.divergence.tolerance = choice.tolerance;
  apply_solver(solver, parameters);
  parameters.filter *= depth_measures(parameters.scheme, layers).filter_factor;
  if (parameters.viscosity < 0.0) parameters.viscosity = default_viscosity(solver.kind, parameters.spacing);
  if (parameters.oil && parameters.oil->viscosity < 0.0)
    parameters.oil->viscosity = parameters.oil->rest_density * parameters.viscosity;
  return parameters;
}

}  // namespace

WaterRun::WaterRun(int threads, FluidParameters parameters, const SolverChoice& solver, const Start& start)
    : pool_(std::make_unique<TaskPool>(threads)),
      layers_(layers_of(parameters, start)),
      state_(make_fluid(*pool_, with_solver(std::move(parameters), solver, layers_), start.positions, start.phase)) {
  std::copy(start.velocities.begin(), start.velocities.end(), state_.particles.velocity.begin());
  particles_ = start.positions.size();
  limit_steps(0.07, 0.4);
}

void WaterRun::limit_steps(double factor, double cfl) {
  const double gravity = state_.parameters.gravity > 0.0 ? state_.parameters.gravity : 9.81;
  const FluidParameters& q = state_.parameters;
  max_step_ = factor * std::sqrt(q.spacing / gravity) * depth_measures(q.scheme, layers_).step_factor;
  if (q.viscosity > 0.0) max_step_ = std::min(max_step_, kViscousStep * q.spacing * q.spacing / q.viscosity);
  cfl_ = cfl;
}

void WaterRun::advance_to(double time, const std::function<void()>& each) {
  while (time_ < time - 1e-12) {
    const double admissible = choose_time_step(state_.parameters, cfl_, max_step_, speed_);
    const double left = time - time_;
    step(left / std::max(1.0, std::ceil(left / admissible - 1e-9)));
    if (each) each();
  }
}

void WaterRun::step(double dt) {
  const std::int64_t begin = monotonic_ns();
  last_ = step_water(*pool_, state_, dt, monotonic_ns);
  wall_s_ += 1e-9 * static_cast<double>(monotonic_ns() - begin);
  time_ += dt;
  speed_ = last_.largest_speed;
  if (last_.not_finite > 0) throw std::runtime_error("values are not finite at t = " + std::to_string(time_) + " s");
  sums_.add(last_);
}

RunCost WaterRun::cost() const { return run_cost(sums_, particles_, wall_s_); }

RunCost run_cost(const StepSums& sums, std::size_t particles, double wall_s) {
  RunCost cost;
  cost.particles = particles;
  cost.steps = static_cast<std::int64_t>(sums.steps);
  cost.simulated_s = sums.simulated_s;
  cost.wall_s = wall_s;
  cost.density_iterations = sums.mean(sums.density_iterations);
  cost.velocity_iterations = sums.mean(sums.divergence_iterations);
  cost.density_error = sums.mean(sums.density_error);
  cost.density_error_peak = sums.density_error_peak;
  cost.largest_density = sums.largest_density_peak;
  cost.unconverged_steps = static_cast<std::int64_t>(sums.unconverged_steps);
  return cost;
}

StepReport WaterRun::measure() {
  StepReport report;
  measure_fluid(*pool_, state_, 0.0, report);
  return report;
}

FluidParameters patch_parameters(const std::array<double, 3>& size, double spacing, const std::array<Edge, 3>& edges) {
  FluidParameters p;
  p.spacing = spacing;
  p.support_radius = 2.0 * spacing;
  p.viscosity = -1.0;  // the solver's default
  p.edges = edges;
  for (std::size_t a = 0; a < 3; ++a) p.patch.max[a] = static_cast<float>(size[a]);
  return p;
}

Start fill_block(const FluidParameters& parameters, const std::array<double, 3>& size) {
  const double d = parameters.spacing;
  std::array<double, 3> first{};
  std::array<int, 3> n{};
  for (std::size_t a = 0; a < 3; ++a) {
    const bool wall = parameters.edges[a] == Edge::kWall;
    first[a] = static_cast<double>(parameters.patch.min[a]) + (wall ? 1.0 : 0.5) * d;
    n[a] = static_cast<int>(std::floor(size[a] / d + 1e-6)) - (wall ? 1 : 0);
  }
  Start start;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        start.positions.push_back({static_cast<float>(first[0] + d * i), static_cast<float>(first[1] + d * j),
                                   static_cast<float>(first[2] + d * k), 0.0F});
  return start;
}

}  // namespace pelagos::validation
