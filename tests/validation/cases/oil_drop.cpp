#include <cmath>

#include "harness.hpp"
#include "two_liquids.hpp"

namespace pelagos::validation {

namespace {

constexpr double kSpacing = 0.05, kRadius = 0.4;  // m
constexpr float kMiddle = 2.0F;                   // m: no drop that flies off reaches a face
constexpr int kSteps = 400;

/// A ball, oil on its right, whose halves fly at each other and spin, without gravity.
Start ball(const FluidParameters& parameters) {
  Start all = fill_block(parameters, {2.0 * kMiddle, 2.0 * kMiddle, 2.0 * kMiddle}), start;
  for (const Float4& p : all.positions) {
    const float x = p.x - kMiddle, y = p.y - kMiddle, z = p.z - kMiddle;
    if (x * x + y * y + z * z > static_cast<float>(kRadius * kRadius)) continue;
    start.positions.push_back(p);
    start.velocities.push_back({-2.0F * y - (x > 0.0F ? 0.5F : -0.5F), 2.0F * x, 0.0F, 0.0F});
    start.phase.push_back(x > 0.1F ? kOilPhase : kWaterPhase);
  }
  return start;
}

void run_drop(Session& session, const Subject& subject, double oil_density) {
  FluidParameters parameters = patch_parameters({2 * kMiddle, 2 * kMiddle, 2 * kMiddle}, kSpacing,
                                                {Edge::kMirror, Edge::kMirror, Edge::kMirror});
  parameters.gravity = 0.0;
  parameters.oil = PhaseParameters{oil_density, -1.0};
  WaterRun run(session.options().threads, parameters, {subject.solver}, ball(parameters));
  const test::PhaseMomentum before = test::momentum_of(run.state());
  double furthest = 0.0;
  for (int k = 1; k <= kSteps; ++k) {
    run.advance_to(0.002 * k);
    const test::PhaseMomentum now = test::momentum_of(run.state());
    double drift = 0.0;
    for (std::size_t a = 0; a < 3; ++a) drift = std::hypot(drift, now.sum[a] - before.sum[a]);
    furthest = std::max(furthest, drift / before.scale);
    session.progress(subject, static_cast<double>(k) / kSteps);
  }
  session.add(subject, {"momentum drift", furthest, "of the momenta's magnitudes", "0; single precision keeps 1e-6",
                        at_most(1e-6, 1e-4)});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_oil_drop(Session& session) {
  for (const double density : {800.0, 100.0}) {
    if (session.quick() && density < 800.0) continue;
    for (const std::string& solver : session.solvers({"corrected", "hybrid", "dfsph", "pbf"})) {
      const Subject subject{"oil_drop", density > 500.0 ? "oil of 800" : "oil of 100", solver, kSpacing};
      session.attempt(subject, [&] { run_drop(session, subject, density); });
    }
  }
}

}  // namespace pelagos::validation
