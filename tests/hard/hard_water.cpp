#include "hard_water.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulation/deep_water.hpp"
#include "simulation/fluid_setup.hpp"
#include "solver_names.hpp"

namespace pelagos::hard {

HardWater::HardWater(const FluidParameters& parameters, const std::vector<Float4>& positions, int threads,
                     const std::vector<std::uint8_t>& phase, int layers)
    : pool_(threads),
      state_(make_fluid(pool_, parameters, positions, phase)),
      step_factor_(depth_measures(parameters.scheme, layers).step_factor) {
  state_.parameters.filter *= depth_measures(parameters.scheme, layers).filter_factor;
  start_watch();
}

double HardWater::step_unit() const {
  return std::sqrt(state_.parameters.spacing / (state_.parameters.gravity > 0.0 ? state_.parameters.gravity : 9.81));
}

void HardWater::start_watch() {
  StepReport now;
  measure_fluid(pool_, state_, 0.0, now);
  energy_ = EnergyWatch(now.kinetic_energy + now.potential_energy);
}

void HardWater::settle(int steps) {
  settle_fluid(pool_, state_, steps);
  start_watch();
}

StepReport HardWater::step(double dt) {
  const StepReport report = step_water(pool_, state_, dt);
  note(report);
  return report;
}

void HardWater::note(const StepReport& report) {
  if (report.not_finite > 0 || broken()) {
    ++steps_broken_;
    not_finite_ = std::max(not_finite_, report.not_finite);
    return;
  }
  sums_.add(report);
  speed_ = report.largest_speed;
  energy_.add(report.kinetic_energy + report.potential_energy);
  const double mass = state_.parameters.rest_density * state_.parameters.volume() *
                      static_cast<double>(std::max<std::size_t>(state_.particles.count, 1));
  rms_.push_back(std::sqrt(2.0 * report.kinetic_energy / mass));
}

void HardWater::run(double time, double factor, double cfl) {
  const double longest = factor * step_unit() * step_factor_;
  double gone = 0.0;
  while (gone < time && !broken()) {
    double dt = longest;
    if (cfl > 0.0) dt = std::max(admissible_time_step(state_.parameters, cfl, longest, speed_), 0.1 * longest);
    step(dt);
    gone += dt;
  }
}

Outcome HardWater::outcome() const {
  Outcome out;
  out.steps = static_cast<int>(sums_.steps) + steps_broken_;
  out.not_finite = not_finite_;
  out.outside = sums_.outside_peak;
  out.capped = static_cast<std::int64_t>(sums_.capped);
  out.unconverged = static_cast<int>(sums_.unconverged_steps);
  out.density_error = sums_.density_error_peak;
  out.mean_density_error = sums_.mean(sums_.density_error);
  out.largest_density = sums_.largest_density_peak;
  out.energy_rise = energy_.largest_rise();
  out.density_iterations = sums_.mean(sums_.density_iterations);
  out.velocity_iterations = sums_.mean(sums_.divergence_iterations);
  out.largest_speed = sums_.largest_speed_peak;
  if (!rms_.empty()) {
    out.rms_speed = rms_.back();
    out.late_rms_speed = *std::max_element(rms_.begin() + static_cast<std::ptrdiff_t>(rms_.size() / 2), rms_.end());
  }
  return out;
}

double HardWater::mean_height() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < state_.particles.count; ++i) sum += static_cast<double>(state_.particles.position[i].z);
  return sum / static_cast<double>(std::max<std::size_t>(state_.particles.count, 1));
}

bool HardWater::all_there() const {
  std::vector<int> times(state_.particles.count, 0);
  for (std::size_t i = 0; i < state_.particles.count; ++i)
    if (state_.particles.id[i] < times.size()) ++times[state_.particles.id[i]];
  return std::all_of(times.begin(), times.end(), [](int t) { return t == 1; });
}

FluidParameters tank_with(const std::string& name, const std::array<double, 3>& size, double spacing,
                          double tolerance) {
  SolverSettings solver;
  if (!choose_solver(name, solver)) throw std::invalid_argument("no solver of the name " + name);
  solver.density.tolerance = solver.divergence.tolerance = tolerance;
  FluidParameters p;
  p.spacing = spacing;
  p.support_radius = 2.0 * spacing;
  apply_solver(solver, p);
  p.viscosity = default_viscosity(solver.kind, spacing);
  for (std::size_t a = 0; a < 3; ++a) p.patch.max[a] = static_cast<float>(size[a]);
  return p;
}

std::vector<Float4> block(const std::array<int, 3>& n, double spacing, const std::array<double, 3>& first) {
  std::vector<Float4> points;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        points.push_back({static_cast<float>(first[0] + i * spacing), static_cast<float>(first[1] + j * spacing),
                          static_cast<float>(first[2] + k * spacing), 0.0F});
  return points;
}

namespace {
constexpr double kSpacing = 0.05;
FluidParameters lattice_tank(const std::string& solver, const std::array<int, 3>& intervals, double tolerance) {
  return tank_with(solver, {intervals[0] * kSpacing, intervals[1] * kSpacing, intervals[2] * kSpacing}, kSpacing,
                   tolerance);
}
}  // namespace

HardWater small_dam(const std::string& solver, double tolerance) {
  return {lattice_tank(solver, {51, 9, 34}, tolerance), block({16, 8, 16}, kSpacing, {kSpacing, kSpacing, kSpacing})};
}

HardWater oil_dam(const std::string& solver, double density_ratio, int threads) {
  FluidParameters parameters = lattice_tank(solver, {51, 9, 34}, 3e-4);
  const double density = density_ratio * parameters.rest_density;
  // A light crude's viscosity, or what keeps particles calm, as the server has it.
  parameters.oil = PhaseParameters{density, std::max(0.0064, density * parameters.viscosity)};
  const std::vector<Float4> positions = block({16, 8, 16}, kSpacing, {kSpacing, kSpacing, kSpacing});
  std::vector<std::uint8_t> phase;
  for (const Float4& p : positions)
    phase.push_back(static_cast<double>(p.z) > 12.5 * kSpacing ? kOilPhase : kWaterPhase);
  return {parameters, positions, threads, phase};
}

HardWater still_column(const std::string& solver, int layers, double tolerance) {
  return {lattice_tank(solver, {10, 10, layers + 6}, tolerance),
          block({9, 9, layers}, kSpacing, {kSpacing, kSpacing, kSpacing}),
          1,
          {},
          layers};
}

HardWater still_sea(const std::string& solver, int layers, double tolerance) {
  FluidParameters parameters = lattice_tank(solver, {40, 4, layers + 4}, tolerance);
  parameters.edges = {Edge::kPeriodic, Edge::kPeriodic, Edge::kMirror};
  const std::array<double, 3> first{0.5 * kSpacing, 0.5 * kSpacing, 0.5 * kSpacing};
  return {parameters, block({40, 4, layers}, kSpacing, first), 1, {}, layers};
}

HardWater sloshing_tank(const std::string& solver) {
  std::vector<Float4> points = block({24, 5, 12}, kSpacing, {kSpacing, kSpacing, kSpacing});
  // The surface slopes by a quarter: 12 layers at one end, 6 at the other.
  std::erase_if(points, [](const Float4& p) { return p.z > 0.61F - 0.25F * p.x; });
  return {lattice_tank(solver, {25, 6, 24}, 3e-4), points};
}

}  // namespace pelagos::hard
