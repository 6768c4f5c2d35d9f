#include "travelling_wave.hpp"

#include <cmath>
#include <complex>

#include "harness.hpp"
#include "measures.hpp"
#include "waves.hpp"

namespace pelagos::validation {

namespace {

/// Relaxation steps that take out the pop of a lattice against samples.
constexpr int kFloorSettling = 100;

LinearWave linear_wave(const TravellingWave& wave, double gravity) {
  return {2.0 * M_PI / wave.length, wave.depth, gravity};
}

}  // namespace

WaterRun start_travelling(int threads, const TravellingWave& wave, const SolverChoice& solver) {
  const double d = wave.spacing, width = wave.slice * d;
  const Edge floor = wave.sampled_floor ? Edge::kWall : Edge::kMirror;
  FluidParameters parameters = patch_parameters({wave.length, width, 1.5 * wave.depth + 4.0 * wave.amplitude}, d,
                                                {Edge::kPeriodic, Edge::kPeriodic, floor});
  parameters.viscosity = wave.viscosity;
  // Over samples the lowest layer stands a spacing above them: a block that is one spacing higher holds as many layers.
  Start start = fill_block(parameters, {wave.length, width, wave.depth + (wave.sampled_floor ? d : 0.0)});
  start.velocities = start_wave(linear_wave(wave, parameters.gravity), wave.amplitude, false, start.positions);
  WaterRun run(threads, parameters, solver, start);
  if (wave.sampled_floor) run.settle(kFloorSettling);
  return run;
}

TravellingResult run_travelling(WaterRun& run, const TravellingWave& wave, int periods,
                                const std::function<void(int, const TravellingResult&)>& each,
                                const std::function<void(double)>& moved) {
  const LinearWave linear = linear_wave(wave, run.state().parameters.gravity);
  const auto mode = [&] {
    return surface_mode(run.state().particles, run.state().parameters.volume(), linear.wavenumber, wave.length,
                        wave.slice * wave.spacing);
  };
  const std::complex<double> first = mode();
  TravellingResult result;
  double phase = 0.0;
  for (int n = 1; n <= periods; ++n) {
    run.advance_to(n * linear.period(), [&] { moved(run.time() / (periods * linear.period())); });
    const std::complex<double> now = mode();
    // A wave that runs ahead turns the mode exp(-i k x) to negative angles. Less than half a period a period.
    const double turned = -std::arg(now / first) / (2.0 * M_PI);
    phase = turned + std::round(phase - turned);
    result.amplitude = std::abs(now) / std::abs(first);
    result.loss = 1.0 - std::pow(result.amplitude, 1.0 / n);
    result.phase = phase / n;
    result.noise = fit_velocity(linear, run.state().particles).noise;
    each(n, result);
  }
  return result;
}

namespace {

struct Setup {
  const char* name;
  TravellingWave wave;
  bool quick;
  std::vector<std::string> solvers;
  double aim, bound;  ///< of the loss a period, %
};

const std::vector<std::string> kAll{"corrected", "hybrid", "dfsph", "pbf"}, kPlain{"hybrid", "dfsph"},
    kDefault{"corrected"};

// Bounds: three times the aim; peers and plain gradients lose 15 to 27 % a period. Over samples, where the correction
// ends, the corrected solver is no better than they are: measured 31 %.
const Setup kSetups[] = {
    {"length 60 d, depth 10 d", {60, 10, 1, 1, 6}, true, kAll, 1.0, 3.0},
    {"length 60 d, depth 30 d", {60, 30, 1, 1, 6}, false, kAll, 1.0, 3.0},
    {"length 30 d, depth 10 d", {30, 10, 1, 1, 6}, false, kDefault, 1.5, 4.5},
    {"length 20 d, depth 10 d", {20, 10, 1, 1, 6}, true, kDefault, 2.0, 6.0},
    {"the first at d/2", {60, 10, 1, 0.5, 6}, false, kDefault, 1.0, 3.0},
    {"the first over a sampled floor", {60, 10, 1, 1, 6, true}, true, kDefault, 3.0, 45.0},
    {"the first without viscosity", {60, 10, 1, 1, 6, false, 0.0}, true, kPlain, 1.0, 100.0},
};

/// Below this share of its first height a wave has died: noise over its orbital speed is then no measure.
constexpr double kDead = 0.05;

void add_results(Session& session, const Subject& subject, int periods, const TravellingResult& r, const Goal& goal) {
  const std::string after = " over " + std::to_string(periods) + " periods";
  session.add(subject, {"loss a period" + after, 100.0 * r.loss, "%", "0; peers 15 to 27 %", goal});
  session.add(subject,
              {"phase error a period" + after, 100.0 * r.phase, "%", "w^2 = g k tanh(k h)", at_most(1.0, 3.0)});
  session.add(subject, {"noise over orbital speed" + after, r.amplitude < kDead ? NAN : r.noise, "", "0"});
}

void run_one(Session& session, const Setup& setup, const Subject& subject) {
  WaterRun run = start_travelling(session.options().threads, setup.wave, {subject.solver});
  Series series = session.series(subject, "amplitude", "periods,amplitude,phase,noise");
  series.add({0, 1, 0, 0});
  const Goal goal = at_most(setup.aim, setup.bound);
  const int periods = session.quick() ? 3 : 10;
  const double energy = mechanical_energy(run);
  (void)run_travelling(
      run, setup.wave, periods,
      [&](int n, const TravellingResult& r) {
        series.add({static_cast<double>(n), r.amplitude, r.phase * n, r.noise});
        if (n == 3 || n == 10) add_results(session, subject, n, r, goal);
      },
      [&](double share) { session.progress(subject, share); });
  const FluidParameters& q = run.state().parameters;
  const double wave_energy = 0.5 * q.rest_density * q.gravity * setup.wave.amplitude * setup.wave.amplitude *
                             setup.wave.length * setup.wave.slice * setup.wave.spacing;
  const double gained = mechanical_energy(run) - energy;
  session.add(subject, {"mechanical energy gained in all", gained / wave_energy, "of the wave's", "0"});
  const double potential = wave_energy * std::pow(setup.wave.depth / setup.wave.amplitude, 2);  // rho g h^2 / 2 an area
  session.add(subject, energy_rise(gained, potential));
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_travelling_wave(Session& session) {
  for (const Setup& setup : kSetups) {
    if (session.quick() && !setup.quick) continue;
    for (const std::string& solver : session.solvers(setup.solvers)) {
      const Subject subject{"travelling_wave", setup.name, solver, setup.wave.spacing};
      session.attempt(subject, [&] { run_one(session, setup, subject); });
    }
  }
}

}  // namespace pelagos::validation
