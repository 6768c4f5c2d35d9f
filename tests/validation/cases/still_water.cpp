#include <cmath>

#include "harness.hpp"
#include "measures.hpp"

namespace pelagos::validation {

namespace {

constexpr double kSpacing = 1.0, kLength = 20.0, kSlice = 6.0;  // m
constexpr double kEnd = 30.0, kAverageFrom = 15.0;              // s

void run_one(Session& session, int layers, const Goal& goal, const Subject& subject) {
  const double depth = layers * kSpacing;
  const FluidParameters parameters =
      patch_parameters({kLength, kSlice, 1.3 * depth}, kSpacing, {Edge::kPeriodic, Edge::kPeriodic, Edge::kMirror});
  WaterRun run(session.options().threads, parameters, {subject.solver},
               fill_block(parameters, {kLength, kSlice, depth}));
  Series series = session.series(subject, "speed", "t,rms_speed");
  double sum = 0.0;
  int samples = 0, steps = 0;
  run.advance_to(kEnd, [&] {
    session.progress(subject, run.time() / kEnd);
    const double speed = rms_speed(run.state().particles);
    if (steps++ % 10 == 0) series.add({run.time(), speed});
    if (run.time() <= kAverageFrom) return;
    sum += speed;
    ++samples;
  });
  session.add(subject, {"rms speed", sum / samples, "m/s", "0", goal});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_still_water(Session& session) {
  struct Setup {
    const char* name;
    int layers;
    bool quick;
    Goal goal;
  };
  // Bound: three times the aim.
  const Setup setups[] = {{"15 layers", 15, false, at_most(0.05, 0.15)}, {"30 layers", 30, true, at_most(0.05, 0.15)}};
  for (const Setup& setup : setups) {
    if (session.quick() && !setup.quick) continue;
    for (const std::string& solver : session.solvers({"corrected", "hybrid", "dfsph", "pbf"})) {
      const Subject subject{"still_water", setup.name, solver, kSpacing};
      session.attempt(subject, [&] { run_one(session, setup.layers, setup.goal, subject); });
    }
  }
}

}  // namespace pelagos::validation
