#include <fmt/format.h>

#include <cmath>

#include "harness.hpp"
#include "measures.hpp"
#include "physics/pressure.hpp"
#include "two_liquids.hpp"

namespace pelagos::validation {

namespace {

constexpr double kDepth = 1.0, kOil = 800.0;                       // m, half of it oil; kg/m^3
constexpr double kEnd = 5.0, kAverageFrom = 4.0;                   // s
constexpr double kBottom = 9.81 * 0.5 * kDepth * (1000.0 + kOil);  // Pa

/// Pressure over height of the water, from two spacings above the bottom to two below the interface.
void add_pressure(const FluidState& state, LineFit& fit, std::vector<float>& pressure) {
  const double d = state.parameters.spacing;
  pressure.resize(state.particles.count);
  compute_pressure(state, pressure);
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    const auto z = static_cast<double>(state.particles.position[i].z);
    if (z > 2.0 * d && z < 0.5 * kDepth - 2.0 * d) fit.add(z, static_cast<double>(pressure[i]));
  }
}

void run_layers(Session& session, const Subject& subject, int layers) {
  const double d = kDepth / layers;
  TwoLiquids box{10 * d, 1.3 * kDepth, kDepth, d, kOil, true};
  WaterRun run(session.options().threads, box.parameters(), {subject.solver},
               box.start([](double, double z) { return z > 0.5 * kDepth; }));
  const double oil = test::mean_height_of(run.state(), kOilPhase),
               water = test::mean_height_of(run.state(), kWaterPhase);
  run.advance_to(kAverageFrom, [&] { session.progress(subject, run.time() / kEnd); });
  LineFit pressure;
  std::vector<float> buffer;
  double kinetic = 0.0;
  int steps = 0;
  run.advance_to(kEnd, [&] {
    kinetic += run.last().kinetic_energy;
    if (steps++ % 5 == 0) add_pressure(run.state(), pressure, buffer);
  });
  const FluidState& state = run.state();
  const double mass_height = 0.5 * (1000.0 + kOil) * static_cast<double>(state.particles.count) * d * d * d * 9.81;
  session.add(subject, {"bottom pressure error", 100.0 * (pressure.at(0.0) / kBottom - 1.0), "%", "weight of both",
                        at_most(0.2, 2.5)});
  session.add(subject,
              {"oil sank by", (oil - test::mean_height_of(state, kOilPhase)) / d, "d", "0", at_most(0.25, 0.5)});
  session.add(subject,
              {"water rose by", (test::mean_height_of(state, kWaterPhase) - water) / d, "d", "0", at_most(0.25, 0.5)});
  session.add(subject, {"deepest particle in the other liquid", deepest_intruder(state, true) / d, "d",
                        "they stay layered", at_most(0.25, 1.0)});
  session.add(subject, {"kinetic energy left after 5 s", kinetic / steps / mass_height / kDepth, "m g H", "0",
                        at_most(1e-5, 1e-3)});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_oil_at_rest(Session& session) {
  for (const int layers : {20, 40}) {
    if (session.quick() && layers > 20) continue;
    for (const std::string& solver : session.solvers({"corrected", "hybrid"})) {
      const Subject subject{"oil_at_rest", fmt::format("H/d {}", layers), solver, kDepth / layers};
      session.attempt(subject, [&] { run_layers(session, subject, layers); });
    }
  }
}

}  // namespace pelagos::validation
