#include <gtest/gtest.h>

#include <memory>

#include "oil_scene.hpp"

namespace pelagos::test {
namespace {

// A periodic box of particles at rest density that shear, without gravity: viscosity alone acts between solves.

constexpr double kSpacing = 0.05;

FluidParameters shear_box(double oil_density, double oil_viscosity, double water_viscosity) {
  FluidParameters parameters = patch_parameters({0.5, 0.5, 0.5}, kSpacing);
  parameters.scheme = Scheme::kCorrected;
  parameters.edges = {Edge::kPeriodic, Edge::kPeriodic, Edge::kPeriodic};
  parameters.gravity = 0.0;
  parameters.filter = 0.0;
  parameters.viscosity = water_viscosity;
  parameters.oil = PhaseParameters{oil_density, oil_viscosity};
  return parameters;
}

/// v_x = cos(2 pi z / 0.5 m), oil above 0.25 m or everywhere.
std::unique_ptr<WaterScene> shear(const FluidParameters& parameters, bool all_oil) {
  const std::vector<Float4> points = lattice({10, 10, 10}, kSpacing, {0.025, 0.025, 0.025});
  auto water = std::make_unique<WaterScene>(2, parameters, points,
                                            mark_oil(points, [&](const Float4& p) { return all_oil || p.z > 0.25F; }));
  for (std::size_t i = 0; i < points.size(); ++i)
    water->state.particles.velocity[i] = {std::cos(12.566371F * points[i].z), 0, 0, 0};
  return water;
}

double largest_speed(const FluidState& state) {
  double fastest = 0;
  for (std::size_t i = 0; i < state.particles.count; ++i)
    fastest = std::max(fastest, std::abs(static_cast<double>(state.particles.velocity[i].x)));
  return fastest;
}

TEST(PhaseViscosity, ImplicitAndExplicitStepsAgree) {
  // 100 explicit steps of 0.5 ms at nu dt / d^2 = 0.05 (nu = 0.25 m^2/s), against implicit steps twice and eight times
  // as long, which pass the explicit bound of 0.1. The slowest mode's rate: 0.71 nu k^2 on a lattice (see
  // compute_acceleration), 28 /s.
  const FluidParameters parameters = shear_box(900.0, 225.0, 0.0);
  const double time = 0.024, rate = 0.71 * 0.25 * std::pow(4.0 * M_PI, 2);
  for (const double dt : {0.001, 0.004}) {
    const std::unique_ptr<WaterScene> made = shear(parameters, true);
    WaterScene& water = *made;
    int iterations = 0;
    for (int n = 0; n < std::lround(time / dt); ++n) {
      const StepReport report = water.step(dt);
      EXPECT_TRUE(report.viscosity.converged);
      EXPECT_GT(report.viscosity.iterations, 0);
      iterations = std::max(iterations, report.viscosity.iterations);
    }
    EXPECT_LE(iterations, 12) << dt;
    // Implicit Euler's own decay, not the exact one.
    const double expected = std::cos(0.1 * M_PI) * std::pow(1.0 + rate * dt, -time / dt);
    EXPECT_NEAR(largest_speed(water.state), expected, 0.05 * expected) << dt;
  }
}

TEST(PhaseViscosity, AnExplicitStepDecaysAtItsRate) {
  const FluidParameters parameters = shear_box(900.0, 22.5, 0.0);  // nu = 0.025 m^2/s: 0.05 of d^2 / dt at 5 ms
  const std::unique_ptr<WaterScene> made = shear(parameters, true);
  WaterScene& water = *made;
  for (int n = 0; n < 40; ++n) EXPECT_EQ(water.step(0.005).viscosity.iterations, 0);
  const double rate = 0.71 * 0.025 * std::pow(4.0 * M_PI, 2);
  const double expected = std::cos(0.1 * M_PI) * std::exp(-rate * 0.195);  // the first step acts without viscosity
  EXPECT_NEAR(largest_speed(water.state), expected, 0.05 * expected);
}

TEST(PhaseViscosity, MomentumStaysBetweenPhasesOfAnyViscosity) {
  for (const double oil_viscosity : {0.5, 26.0, 1000.0})
    for (const double water_viscosity : {0.0, 0.01, 1.0}) {
      const std::unique_ptr<WaterScene> made = shear(shear_box(300.0, oil_viscosity, water_viscosity), false);
      WaterScene& water = *made;
      for (std::size_t i = 0; i < water.state.particles.count; ++i) water.state.particles.velocity[i].x += 1.0F;
      const PhaseMomentum before = momentum_of(water.state);
      double energy = water.measure().kinetic_energy;
      for (int n = 0; n < 20; ++n) {
        const StepReport report = water.step(0.005);
        ASSERT_EQ(report.not_finite, 0U);
        EXPECT_LT(report.kinetic_energy, energy * (1 + 1e-3)) << n;  // repairs of position lift by tenths of it
        energy = report.kinetic_energy;
      }
      const PhaseMomentum after = momentum_of(water.state);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after.sum[c], before.sum[c], 2e-6 * before.scale) << c;
    }
}

TEST(PhaseViscosity, ThickOilDragsThinWaterByTheHarmonicMean) {
  // Two particles 0.6 h apart, one oil, one water, approaching: accelerations are opposite in the ratio of densities.
  FluidParameters parameters = patch_parameters({1, 1, 1}, kSpacing);
  parameters.gravity = 0.0;
  parameters.viscosity = 0.001;                  // mu = 1 Pa s
  parameters.oil = PhaseParameters{500.0, 3.0};  // harmonic mean 1.5 Pa s
  const std::vector<Float4> points{{0.50F, 0.5F, 0.5F, 0}, {0.56F, 0.5F, 0.5F, 0}};
  const auto accelerations = [&](const std::vector<std::uint8_t>& phase) {
    WaterScene water(1, parameters, points, phase);
    static_cast<void>(water.step(1e-6));
    const std::vector<std::size_t> place = water.place_of_id();
    water.state.particles.velocity[place[0]] = {0.5F, 0, 0, 0};
    water.state.particles.velocity[place[1]] = {-0.5F, 0, 0, 0};
    StepReport report;
    start_acceleration(water.pool, water.state, report);
    return std::array<double, 2>{static_cast<double>(water.state.particles.acceleration[place[0]].x),
                                 static_cast<double>(water.state.particles.acceleration[place[1]].x)};
  };
  const auto both = accelerations({kWaterPhase, kOilPhase}), oils = accelerations({kOilPhase, kOilPhase});
  EXPECT_LT(both[0], 0.0);
  EXPECT_NEAR(1000.0 * both[0] + 500.0 * both[1], 0.0, 1e-3 * std::abs(500.0 * both[1]));
  EXPECT_NEAR(500.0 * oils[0] / (1000.0 * both[0]), 3.0 / 1.5, 1e-3);
}

}  // namespace
}  // namespace pelagos::test
