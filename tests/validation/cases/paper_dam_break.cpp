#include <algorithm>
#include <array>
#include <cmath>

#include "harness.hpp"

namespace pelagos::validation {

namespace {

// The paper's section VI.A with L = 1 m; the same numbers as scenes/dam_break.scene.
constexpr double kSpacing = 0.05;  // m
constexpr int kSettleSteps = 50;
constexpr double kTolerance = 1e-4;                    // the paper gives none
constexpr double kSnapshots[] = {0.4, 0.8, 1.6, 3.2};  // s

struct Size {
  const char* name;
  std::array<double, 3> tank, block;  ///< m
  int steps;
};
constexpr Size kPaper{"35061 particles", {5, 3, 5}, {1.6, 1.5, 2.0}, 3500};
constexpr Size kSmall{"small block", {2.5, 1.5, 2.5}, {0.8, 0.75, 1.0}, 300};

double solver_ms(const StageTimes& times, Stage stage) {
  return 1e-6 * static_cast<double>(times.ns[static_cast<std::size_t>(stage)]);
}

double mean_density(const FluidParticles& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) sum += static_cast<double>(p.density[i]);
  return sum / static_cast<double>(p.count);
}

/// The particles within one and a half spacings of the plane y = `middle`.
void write_snapshot(Session& session, const Subject& subject, const WaterRun& run, std::size_t number, double middle) {
  Series series = session.series(subject, "snapshot" + std::to_string(number), "x,z,density");
  const FluidParticles& p = run.state().particles;
  for (std::size_t i = 0; i < p.count; ++i)
    if (std::abs(static_cast<double>(p.position[i].y) - middle) < 1.5 * kSpacing)
      series.add({static_cast<double>(p.position[i].x), static_cast<double>(p.position[i].z),
                  static_cast<double>(p.density[i])});
}

struct Sums {
  double mean = 0, largest = 0, density_ms = 0, velocity_ms = 0, energy_rise = 0;
};

void run_one(Session& session, const Size& size, const Subject& subject) {
  const FluidParameters parameters = patch_parameters(size.tank, kSpacing, {Edge::kWall, Edge::kWall, Edge::kWall});
  WaterRun run(session.options().threads, parameters, {subject.solver, kTolerance}, fill_block(parameters, size.block));
  run.settle(kSettleSteps);
  const double rho0 = parameters.rest_density;
  Series series = session.series(subject, "steps",
                                 "step,t,density_iterations,velocity_iterations,mean_density,largest_density,"
                                 "density_ms,velocity_ms,energy");
  Sums sums;
  int step = 0;
  std::size_t snapshot = 0;
  double lowest = INFINITY, first = 0.0;
  // Frames of 1/30 s, as the server makes them; the last one is cut where the steps are done.
  for (int frame = 1; step < size.steps; ++frame) {
    run.advance_to(frame / 30.0, [&] {
      const StepReport& r = run.last();
      const double energy = r.kinetic_energy + r.potential_energy;
      if (step == 0) first = energy;
      lowest = std::min(lowest, energy);
      sums.energy_rise = std::max(sums.energy_rise, (energy - lowest) / first);
      const double mean = mean_density(run.state().particles);
      sums.mean += mean;
      sums.largest = std::max(sums.largest, r.largest_density);
      sums.density_ms += solver_ms(r.times, Stage::kDensitySolve);
      sums.velocity_ms += solver_ms(r.times, Stage::kDivergenceSolve);
      series.add({static_cast<double>(++step), run.time(), static_cast<double>(r.density.iterations),
                  static_cast<double>(r.divergence.iterations), rho0 * mean, rho0 * r.largest_density,
                  solver_ms(r.times, Stage::kDensitySolve), solver_ms(r.times, Stage::kDivergenceSolve),
                  energy / first});
    });
    session.progress(subject, static_cast<double>(step) / size.steps);
    if (snapshot < std::size(kSnapshots) && run.time() >= kSnapshots[snapshot] - 1e-9)
      write_snapshot(session, subject, run, ++snapshot, 0.5 * size.block[1]);
  }
  const RunCost cost = run.cost();
  session.add(subject, {"density iterations a step", cost.density_iterations, "",
                        subject.solver == "hybrid-paper"  ? "paper 9.3"
                        : subject.solver == "dfsph-paper" ? "paper 12.0"
                                                          : "-"});
  session.add(subject, {"divergence iterations a step", cost.velocity_iterations, "", "paper 1.0 (hybrid; DFSPH)"});
  session.add(subject, {"mean density", rho0 * sums.mean / step, "kg/m^3", "-"});
  session.add(subject, {"largest density", rho0 * sums.largest, "kg/m^3", "-", at_most(1.1 * rho0, 1.3 * rho0)});
  session.add(subject, {"density error", 100.0 * cost.density_error, "%", "0", at_most(0.1, 1.0)});
  session.add(subject,
              {"energy above its lowest so far", 100.0 * sums.energy_rise, "% of the start", "0", at_most(1.0, 5.0)});
  session.add(subject, {"time of the density solve", sums.density_ms / step, "ms a step", "-"});
  session.add(subject, {"time of the divergence solve", sums.velocity_ms / step, "ms a step", "-"});
  session.add_cost(subject, cost);
}

}  // namespace

void run_paper_dam_break(Session& session) {
  const Size& size = session.quick() ? kSmall : kPaper;
  for (const std::string& solver :
       session.solvers({"hybrid-paper", "dfsph-paper", "pbf-paper", "hybrid", "dfsph", "pbf", "corrected"})) {
    Size own = size;
    // The three of the paper's figures run as long as the paper's; the others show what they are.
    if (!session.quick() && solver.find("-paper") == std::string::npos) own.steps = 1000;
    const Subject subject{"paper_dam_break", own.name, solver, kSpacing};
    session.attempt(subject, [&] { run_one(session, own, subject); });
  }
}

}  // namespace pelagos::validation
