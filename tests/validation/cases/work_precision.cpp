#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "dam_break.hpp"
#include "harness.hpp"
#include "measures.hpp"
#include "physics/pressure.hpp"
#include "travelling_wave.hpp"

namespace pelagos::validation {

namespace {

/// One point of the sweeps; the middle one of each is the same.
struct Knobs {
  std::string sweep;  ///< which knob was turned
  double tolerance = 3e-4;
  double step = 0.07;     ///< longest time step, sqrt(d/g)
  double refinement = 1;  ///< spacings of the middle in one of this
};

bool is_middle(const Knobs& knobs) {
  const Knobs middle;
  return knobs.tolerance == middle.tolerance && knobs.step == middle.step && knobs.refinement == middle.refinement;
}

std::vector<Knobs> sweeps(bool quick) {
  if (quick) return {{"tolerance"}, {"tolerance", 1e-3}};
  return {{"tolerance", 3e-3},   {"tolerance", 1e-3},
          {"tolerance"},         {"tolerance", 1e-4},
          {"step", 3e-4, 0.14},  {"step"},
          {"step", 3e-4, 0.035}, {"resolution", 3e-4, 0.07, 0.5},
          {"resolution"},        {"resolution", 3e-4, 0.07, 2.0}};
}

struct Point {
  double error = 0;  ///< of the reference, see the case
  RunCost cost;
};

/// A wave 60 m long over 10 m: loss of height a period, %.
Point run_wave(Session& session, const Knobs& knobs, const Subject& subject) {
  TravellingWave wave;
  wave.spacing = 1.0 / knobs.refinement;
  wave.slice = 4;
  WaterRun run = start_travelling(session.options().threads, wave, {subject.solver, knobs.tolerance});
  run.limit_steps(knobs.step, 0.4);
  const TravellingResult result = run_travelling(
      run, wave, 2, [](int, const TravellingResult&) {}, [&](double share) { session.progress(subject, share); });
  return {100.0 * result.loss, run.cost()};
}

/// Still water 1 m deep, 20 layers in the middle: error of the bottom pressure, %.
Point run_column(Session& session, const Knobs& knobs, const Subject& subject) {
  constexpr double kDepth = 1.0, kEnd = 2.0, kFrom = 1.0;  // m, s
  const double d = kDepth / (20.0 * knobs.refinement), width = 4.0 * d;
  const FluidParameters parameters =
      patch_parameters({0.5, width, 1.3 * kDepth}, d, {Edge::kMirror, Edge::kPeriodic, Edge::kMirror});
  WaterRun run(session.options().threads, parameters, {subject.solver, knobs.tolerance},
               fill_block(parameters, {0.5, width, kDepth}));
  run.limit_steps(knobs.step, 0.4);
  LineFit profile;
  std::vector<float> pressure(run.state().particles.count);
  run.advance_to(kEnd, [&] {
    session.progress(subject, run.time() / kEnd);
    if (run.time() < kFrom) return;
    compute_pressure(run.state(), pressure);
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const auto z = static_cast<double>(run.state().particles.position[i].z);
      if (z < kDepth - 2.0 * d) profile.add(z, static_cast<double>(pressure[i]));
    }
  });
  const double weight = parameters.rest_density * parameters.gravity * kDepth;
  return {100.0 * std::abs(profile.at(0.0) / weight - 1.0), run.cost()};
}

/// A column 0.3 m high, 20 layers in the middle, breaks for 0.6 s: the density error alone, %.
Point run_break(Session& session, const Knobs& knobs, const Subject& subject) {
  const DamBreak dam{0.3, 0.6, 1.61, static_cast<int>(std::lround(20.0 * knobs.refinement))};
  WaterRun run = start_dam_break(session.options().threads, dam, {subject.solver, knobs.tolerance});
  run.limit_steps(knobs.step, 0.4);
  run.advance_to(0.6, [&] { session.progress(subject, run.time() / 0.6); });
  return {100.0 * run.cost().density_error, run.cost()};
}

struct Problem {
  const char* name;
  Point (*run)(Session&, const Knobs&, const Subject&);
};
constexpr Problem kProblems[] = {{"wave", run_wave}, {"column", run_column}, {"dam break", run_break}};

std::string setup_name(const Problem& problem, const Knobs& knobs) {
  char text[80];
  std::snprintf(text, sizeof text, "%s, tol %g, dt %g, d/%g", problem.name, knobs.tolerance, knobs.step,
                knobs.refinement);
  return text;
}

/// All sweeps of one problem with one solver. Turning the resolution, error falls as a power of the wall time.
void run_sweeps(Session& session, const Problem& problem, const std::string& solver, Series& table) {
  LineFit slope;
  std::optional<Point> middle;  // run once, shown in every sweep
  for (const Knobs& knobs : sweeps(session.quick())) {
    const Subject subject{"work_precision", setup_name(problem, knobs), solver, 0.0};
    session.attempt(subject, [&] {
      const bool known = is_middle(knobs) && middle;
      const Point point = known ? *middle : problem.run(session, knobs, subject);
      if (is_middle(knobs)) middle = point;
      const RunCost& cost = point.cost;
      table.add(std::string(problem.name) + ',' + solver + ',' + knobs.sweep,
                {knobs.tolerance, knobs.step, knobs.refinement, cost.wall_per_simulated(), point.error,
                 100.0 * cost.density_error, cost.density_iterations + cost.velocity_iterations});
      if (!known) session.add_cost(subject, cost);
      if (knobs.sweep == "resolution") slope.add(std::log(cost.wall_per_simulated()), std::log(std::abs(point.error)));
    });
  }
  if (slope.count() >= 3)
    session.add({"work_precision", problem.name, solver, 0.0},
                {"exponent of the error over wall time by resolution", slope.slope(), "", "-"});
}

}  // namespace

void run_work_precision(Session& session) {
  Series table(session.options().out / "work_precision.csv",
               "problem,solver,sweep,tolerance,step,refinement,wall_per_simulated,error,density_error,iterations");
  for (const Problem& problem : kProblems)
    for (const std::string& solver : session.solvers({"corrected", "hybrid", "dfsph", "pbf"}))
      run_sweeps(session, problem, solver, table);
}

}  // namespace pelagos::validation
