#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>

#include "water_scene.hpp"

namespace pelagos::test {
namespace {

// Mass, momentum and angular momentum of water that nothing touches, for every scheme.

struct Case {
  const char* name;
  Scheme scheme;
  SolveMethod method;
  double viscosity;      ///< m^2/s
  double angular_drift;  ///< allowed share of the starting angular momentum over the run: twice what was measured,
                         ///< 3.2e-3, 1e-6 (rounding, five times allowed), 3.8e-3, 1.9e-2, 3.3e-3 and 4.2e-3
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

constexpr SolveMethod kGradients = SolveMethod::kConjugateGradient, kPaper = SolveMethod::kPaper;
constexpr double kSpacing = 0.05;

class Conservation : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Conservation,
                         testing::Values(Case{"Hybrid", Scheme::kHybrid, kGradients, 0.01, 6.5e-3},
                                         Case{"Dfsph", Scheme::kDfsph, kGradients, 0.01, 5e-6},
                                         Case{"Pbf", Scheme::kPbf, kGradients, 0.01, 7.5e-3},
                                         Case{"Corrected", Scheme::kCorrected, kGradients, 0.0, 3.8e-2},
                                         Case{"HybridPaper", Scheme::kHybrid, kPaper, 0.01, 6.6e-3},
                                         Case{"PbfPaper", Scheme::kPbf, kPaper, 0.01, 8.5e-3}),
                         [](const testing::TestParamInfo<Case>& c) { return c.param.name; });

FluidParameters parameters_of(const Case& c, const Double3& size) {
  FluidParameters parameters = patch_parameters(size, kSpacing);
  parameters.scheme = c.scheme;
  parameters.density.method = parameters.divergence.method = c.method;
  parameters.viscosity = c.viscosity;
  return parameters;
}

Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Motion {
  Double3 linear{}, angular{};  ///< per unit of a particle's mass, about the origin
};
Motion motion(const FluidParticles& p) {
  Motion sum;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Double3 v = as_double(p.velocity[i]), l = cross(as_double(p.position[i]), v);
    for (std::size_t c = 0; c < 3; ++c) {
      sum.linear[c] += v[c];
      sum.angular[c] += l[c];
    }
  }
  return sum;
}

void expect_all_there(const WaterScene& water, std::size_t count) {
  ASSERT_EQ(water.state.particles.count, count);
  for (const std::size_t place : water.place_of_id()) ASSERT_LT(place, count) << "one is lost, another doubled";
}

/// A ball of water about the origin of its patch that spins about z at 3 rad/s and pulsates out of disorder.
std::unique_ptr<WaterScene> spinning_ball(const Case& c) {
  FluidParameters parameters = parameters_of(c, {4, 4, 4});
  for (std::size_t a = 0; a < 3; ++a) {
    parameters.patch.min[a] = -2.0F;
    parameters.patch.max[a] = 2.0F;
  }
  parameters.gravity = 0.0;
  std::vector<Float4> points = lattice({11, 11, 11}, kSpacing, {-0.25, -0.25, -0.25});
  std::erase_if(points, [](const Float4& p) { return p.x * p.x + p.y * p.y + p.z * p.z > 0.28F * 0.28F; });
  jitter(points, 0.1 * kSpacing, 61);
  auto water = std::make_unique<WaterScene>(2, parameters, points);
  const std::vector<Float4> noise = random_vectors(points.size(), 0.1, 62);
  for (std::size_t i = 0; i < points.size(); ++i)
    water->state.particles.velocity[i] = {-3.0F * points[i].y + noise[i].x, 3.0F * points[i].x + noise[i].y,
                                          0.25F + noise[i].z, 0};
  return water;
}

TEST_P(Conservation, FreeFlightKeepsMassAndMomentum) {
  const std::unique_ptr<WaterScene> made = spinning_ball(GetParam());
  WaterScene& water = *made;
  const std::size_t count = water.state.particles.count;
  const Motion before = motion(water.state.particles);
  const int steps = 200;
  for (int n = 0; n < steps; ++n) {
    const StepReport report = water.step(0.003);
    ASSERT_EQ(report.capped, 0U) << n;  // a bounded correction would break a pair's balance
    ASSERT_EQ(report.not_finite, 0U) << n;
  }
  expect_all_there(water, count);
  const Motion after = motion(water.state.particles);
  // Velocities of 1 m/s are held to 6e-8, changed some three times a step; rounding walks at random over particles and
  // steps: six times its standard deviation.
  const double rounding = 6.0 * 6e-8 * std::sqrt(3.0 * steps * static_cast<double>(count));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after.linear[c], before.linear[c], rounding) << c;
  // Forces along the line between two particles keep the angular momentum, corrected gradients point elsewhere, and a
  // step's position moves after its velocity: a drift remains. Bounded by twice what was measured.
  const Double3 drift = minus(after.angular, before.angular);
  const double share = std::sqrt(dot(drift, drift) / dot(before.angular, before.angular));
  RecordProperty("angular_momentum_drift", std::to_string(share));
  std::printf("%s: angular momentum drifts by %.2e in %d steps\n", GetParam().name, share, steps);
  EXPECT_LT(share, GetParam().angular_drift);
  EXPECT_GT(std::sqrt(dot(before.angular, before.angular)), 10.0);
}

TEST_P(Conservation, ADamBreakKeepsItsParticlesInside) {
  const std::array<int, 3> n{8, 7, 9};
  WaterScene water(2, parameters_of(GetParam(), {1.35, 0.4, 1.0}),
                   lattice(n, kSpacing, {kSpacing, kSpacing, kSpacing}));
  const std::size_t count = water.state.particles.count;
  settle_fluid(water.pool, water.state, 20);
  for (int k = 0; k < 150; ++k) {
    const StepReport report = water.step(0.7 * water.largest_step());
    ASSERT_EQ(report.not_finite, 0U) << k;
    ASSERT_EQ(report.outside, 0U) << k;
  }
  expect_all_there(water, count);
}

TEST_P(Conservation, APeriodicBoxKeepsMassAndMomentum) {
  FluidParameters parameters = parameters_of(GetParam(), {0.5, 0.5, 0.5});
  parameters.edges = {Edge::kPeriodic, Edge::kPeriodic, Edge::kPeriodic};
  parameters.gravity = 0.0;
  std::vector<Float4> points = lattice({10, 10, 10}, kSpacing, {0.025, 0.025, 0.025});
  jitter(points, 0.1 * kSpacing, 63);
  WaterScene water(2, parameters, points);
  const std::vector<Float4> noise = random_vectors(points.size(), 0.2, 64);
  for (std::size_t i = 0; i < points.size(); ++i)
    water.state.particles.velocity[i] = {1.0F + noise[i].x, -0.5F + noise[i].y, 0.25F + noise[i].z, 0};
  const Motion before = motion(water.state.particles);
  const int steps = 200;
  for (int k = 0; k < steps; ++k) {
    const StepReport report = water.step(0.003);
    ASSERT_EQ(report.not_finite, 0U) << k;
    ASSERT_EQ(report.capped, 0U) << k;
  }
  expect_all_there(water, points.size());
  const Motion after = motion(water.state.particles);
  // In water that fills its box the pressure is much larger than what it moves, so it rounds more; images stand where
  // rounding puts them, and gradients there may round to other half-precision neighbours. Measured: at most 7e-6 of the
  // momentum (the literal hybrid with its many sweeps); twice that is allowed.
  const double size = std::sqrt(dot(before.linear, before.linear));
  const Double3 drift = minus(after.linear, before.linear);
  RecordProperty("momentum_drift", std::to_string(std::sqrt(dot(drift, drift)) / size));
  EXPECT_LT(std::sqrt(dot(drift, drift)), 1.4e-5 * size);
}

}  // namespace
}  // namespace pelagos::test
