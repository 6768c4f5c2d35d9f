#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "oil_scene.hpp"
#include "physics/pressure.hpp"

namespace pelagos::test {
namespace {

// Water and oil, for every scheme.

constexpr double kSpacing = 0.05;
constexpr SolveMethod kGradients = SolveMethod::kConjugateGradient, kJacobi = SolveMethod::kJacobi,
                      kPaper = SolveMethod::kPaper;

struct Case {
  const char* name;
  Scheme scheme;
  SolveMethod method;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class TwoPhases : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Schemes, TwoPhases,
                         testing::Values(Case{"Hybrid", Scheme::kHybrid, kGradients},
                                         Case{"Dfsph", Scheme::kDfsph, kGradients},
                                         Case{"Pbf", Scheme::kPbf, kGradients},
                                         Case{"Corrected", Scheme::kCorrected, kGradients}),
                         [](const testing::TestParamInfo<Case>& c) { return c.param.name; });

class EveryMethod : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Methods, EveryMethod,
    testing::Values(Case{"Hybrid", Scheme::kHybrid, kGradients}, Case{"HybridJacobi", Scheme::kHybrid, kJacobi},
                    Case{"HybridPaper", Scheme::kHybrid, kPaper}, Case{"Dfsph", Scheme::kDfsph, kGradients},
                    Case{"DfsphJacobi", Scheme::kDfsph, kJacobi}, Case{"DfsphPaper", Scheme::kDfsph, kPaper},
                    Case{"Pbf", Scheme::kPbf, kGradients}, Case{"PbfJacobi", Scheme::kPbf, kJacobi},
                    Case{"PbfPaper", Scheme::kPbf, kPaper}, Case{"Corrected", Scheme::kCorrected, kGradients},
                    Case{"CorrectedJacobi", Scheme::kCorrected, kJacobi}),
    [](const testing::TestParamInfo<Case>& c) { return c.param.name; });

FluidParameters oil_tank(const Case& c, const Double3& size, double oil_density, double oil_viscosity = 0.5) {
  FluidParameters parameters = with_scheme(patch_parameters(size, kSpacing), c.scheme, c.method);
  // Particles of oil have to be kept calm like those of water.
  parameters.oil = PhaseParameters{oil_density, std::max(oil_viscosity, oil_density * parameters.viscosity)};
  return parameters;
}

/// A drop in disorder, oil on its right, spinning, without gravity; small enough to take hundreds of steps.
std::unique_ptr<WaterScene> spinning_drop(const Case& c, double oil_density) {
  FluidParameters parameters = oil_tank(c, {4, 4, 4}, oil_density);
  for (std::size_t a = 0; a < 3; ++a) {
    parameters.patch.min[a] = -2.0F;
    parameters.patch.max[a] = 2.0F;
  }
  parameters.gravity = 0.0;
  std::vector<Float4> points = lattice({11, 11, 11}, kSpacing, {-0.25, -0.25, -0.25});
  std::erase_if(points, [](const Float4& p) { return p.x * p.x + p.y * p.y + p.z * p.z > 0.28F * 0.28F; });
  jitter(points, 0.05 * kSpacing, 61);
  auto water = std::make_unique<WaterScene>(2, parameters, points,
                                            mark_oil(points, [](const Float4& p) { return p.x > 0.06F; }));
  const std::vector<Float4> noise = random_vectors(points.size(), 0.05, 62);
  for (std::size_t i = 0; i < points.size(); ++i)
    water->state.particles.velocity[i] = {-2.0F * points[i].y + noise[i].x, 2.0F * points[i].x + noise[i].y, noise[i].z,
                                          0};
  return water;
}

TEST_P(EveryMethod, ADropOfBothKeepsItsMomentum) {
  for (const double oil_density : {800.0, 100.0}) {
    const std::unique_ptr<WaterScene> made = spinning_drop(GetParam(), oil_density);
    WaterScene& water = *made;
    const PhaseMomentum before = momentum_of(water.state);
    const int steps = 100;
    for (int n = 0; n < steps; ++n) {
      const StepReport report = water.step(0.003);
      ASSERT_EQ(report.not_finite, 0U) << oil_density << ", step " << n;
      ASSERT_EQ(report.capped, 0U) << oil_density << ", step " << n;  // a bounded correction breaks a pair's balance
    }
    const PhaseMomentum after = momentum_of(water.state);
    // Speeds of about 0.5 m/s are held to 3e-8 and changed some five times a step; rounding walks at random over
    // particles and steps: ten times its standard deviation, in units of the water's density.
    const double rounding =
        10.0 * 3e-8 * 1000.0 * std::sqrt(5.0 * steps * static_cast<double>(water.state.particles.count));
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(after.sum[a], before.sum[a], rounding) << oil_density << " " << a;
    EXPECT_GT(before.scale, 1e5 * rounding);
  }
}

/// Five layers of one liquid on five of the other, in a patch that they fill from side to side.
WaterScene layered(const Case& c, double oil_density, bool oil_above, Edge edge, int threads = 2) {
  const std::array<int, 3> n{10, 10, 10};
  const double offset = edge == Edge::kWall ? 1.0 : 0.5, side = (n[0] - 1 + 2 * offset) * kSpacing;
  FluidParameters parameters = oil_tank(c, {side, side, (n[2] + 6) * kSpacing}, oil_density);
  parameters.edges = {edge, edge, edge};
  const std::vector<Float4> points = lattice(n, kSpacing, {offset * kSpacing, offset * kSpacing, offset * kSpacing});
  return {threads, parameters, points, mark_oil(points, [&](const Float4& p) {
            return (static_cast<double>(p.z) > (offset + 4.5) * kSpacing) == oil_above;
          })};
}

TEST_P(TwoPhases, TheLighterRestsOnTheHeavier) {
  for (const Edge edge : {Edge::kMirror, Edge::kWall})
    for (const bool oil_above : {true, false}) {
      WaterScene water = layered(GetParam(), oil_above ? 800.0 : 1250.0, oil_above, edge);
      if (edge == Edge::kWall) settle_fluid(water.pool, water.state, 100);
      const double water_height = mean_height_of(water.state, kWaterPhase),
                   oil_height = mean_height_of(water.state, kOilPhase);
      for (int n = 0; n < 400; ++n) {
        const StepReport report = water.step(water.largest_step());
        ASSERT_EQ(report.not_finite, 0U) << n;
        ASSERT_EQ(report.outside, 0U) << n;
      }
      EXPECT_NEAR(mean_height_of(water.state, kWaterPhase), water_height, 0.25 * kSpacing);
      EXPECT_NEAR(mean_height_of(water.state, kOilPhase), oil_height, 0.25 * kSpacing);
      // Between smooth faces nobody crosses. Particles that wander along sampled walls do, by about a spacing, as they
      // do between the layers of one liquid (there they go on for ever).
      EXPECT_LT(deepest_intruder(water.state, oil_above), (edge == Edge::kMirror ? 0.25 : 1.5) * kSpacing);
    }
}

/// rho0 from the growth of pressure with depth between two pairs of layers, kg/m^3.
double weight_between(const std::vector<double>& pressure, const std::vector<double>& height, std::size_t lower) {
  const auto mean = [&](const std::vector<double>& v, std::size_t k) { return 0.5 * (v[k] + v[k + 1]); };
  return (mean(pressure, lower) - mean(pressure, lower + 2)) / (9.81 * (mean(height, lower + 2) - mean(height, lower)));
}

TEST_P(TwoPhases, PressureGrowsWithTheWeightAbove) {
  WaterScene water = layered(GetParam(), 500.0, true, Edge::kMirror);
  const int steps = 300, last = 150;
  std::vector<double> pressure(10), height(10);  // of the ten layers; ids count the lattice, 10 x 10 a layer
  std::vector<float> of_particle(padded_count(water.state.particles.count));
  for (int n = 0; n < steps; ++n) {
    static_cast<void>(water.step(water.largest_step()));
    if (n < steps - last) continue;
    compute_pressure(water.state, of_particle);
    for (std::size_t i = 0; i < water.state.particles.count; ++i) {
      const std::size_t layer = water.state.particles.id[i] / 100;
      pressure[layer] += static_cast<double>(of_particle[i]) / (100.0 * last);
      height[layer] += static_cast<double>(water.state.particles.position[i].z) / (100.0 * last);
    }
  }
  // Neighbouring layers of a lattice share their pressure unevenly, hence pairs; noise of the particles leaves 10 %.
  EXPECT_NEAR(weight_between(pressure, height, 1), 1000.0, 100.0);
  EXPECT_NEAR(weight_between(pressure, height, 5), 500.0, 50.0);
}

/// A ball of oil of three spacings' radius in the middle of water, just let go; its vertical acceleration over g.
double blob_acceleration(const Case& c, double oil_density) {
  const std::array<int, 3> n{15, 15, 17};
  FluidParameters parameters =
      oil_tank(c, {(n[0] + 1) * kSpacing, (n[1] + 1) * kSpacing, (n[2] + 4) * kSpacing}, oil_density, 0.0);
  const std::vector<Float4> points = lattice(n, kSpacing, {kSpacing, kSpacing, kSpacing});
  const Double3 middle{8 * kSpacing, 8 * kSpacing, 8 * kSpacing};
  WaterScene water(2, parameters, points, mark_oil(points, [&](const Float4& p) {
                     const Double3 off = minus(as_double(p), middle);
                     return dot(off, off) < std::pow(3.1 * kSpacing, 2);
                   }));
  settle_fluid(water.pool, water.state, 50);
  const double dt = 0.5 * water.largest_step();
  const int steps = 20;
  for (int k = 0; k < steps; ++k) static_cast<void>(water.step(dt));
  return mean_rise_of(water.state, kOilPhase) / (9.81 * dt * steps);
}

TEST_P(TwoPhases, LightBlobsRiseAndHeavyOnesSink) {
  // A sphere with the added mass of half the water it displaces: (rho_w - rho_o) / (rho_o + rho_w / 2). Walls 5 radii
  // across and viscosity take some of it, and the pressure that a warm start carries on from step to step some more
  // (measured: 0.24 g to 0.41 g up, 0.27 g to 0.41 g down).
  const double light = blob_acceleration(GetParam(), 500.0), heavy = blob_acceleration(GetParam(), 2000.0);
  std::printf("%s: a blob of half the density rises at %.3f g, of twice the density sinks at %.3f g\n", GetParam().name,
              light, -heavy);
  EXPECT_GT(light, 0.4 * 0.5);
  EXPECT_LT(light, 1.2 * 0.5);
  EXPECT_LT(heavy, -0.6 * 0.4);
  EXPECT_GT(heavy, -1.2 * 0.4);
}

TEST_P(TwoPhases, SameBitsForOneTwoAndSevenThreads) {
  const auto history = [&](int threads) {
    WaterScene water = layered(GetParam(), 800.0, false, Edge::kWall, threads);  // turns over
    std::vector<std::uint64_t> hashes;
    for (int n = 0; n < 15; ++n) {
      static_cast<void>(water.step(water.largest_step()));
      hashes.push_back(state_hash(water.state.particles));
    }
    return hashes;
  };
  const std::vector<std::uint64_t> one = history(1);
  for (const int threads : {2, 7}) EXPECT_EQ(history(threads), one) << threads;
}

TEST_P(TwoPhases, OilThatIsNotThereChangesNothing) {
  const auto history = [&](bool with_oil) {
    FluidParameters parameters = with_scheme(patch_parameters({0.6, 0.4, 0.8}, kSpacing), GetParam().scheme);
    if (with_oil) parameters.oil = PhaseParameters{900.0, 0.1};
    WaterScene water(2, parameters, lattice({6, 7, 8}, kSpacing, {kSpacing, kSpacing, kSpacing}));
    std::vector<std::uint64_t> hashes;
    for (int n = 0; n < 10; ++n) {
      const StepReport report = water.step(water.largest_step());
      hashes.push_back(state_hash(water.state.particles) ^ static_cast<std::uint64_t>(report.pair_passes));
    }
    return hashes;
  };
  EXPECT_EQ(history(true), history(false));
}

TEST(PhaseEnergy, CountsTheMassOfEachPhase) {
  FluidParameters parameters = patch_parameters({1, 1, 2}, kSpacing);
  parameters.oil = PhaseParameters{800.0, 0.0};
  const std::vector<Float4> points{{0.5F, 0.5F, 0.5F, 0}, {0.5F, 0.5F, 1.5F, 0}};
  WaterScene water(1, parameters, points, std::vector<std::uint8_t>{kWaterPhase, kOilPhase});
  water.state.particles.velocity[0] = {2, 0, 0, 0};
  water.state.particles.velocity[1] = {0, 3, 0, 0};
  const StepReport report = water.measure();
  const double volume = parameters.volume();
  EXPECT_NEAR(report.kinetic_energy, volume * (0.5 * 1000 * 4 + 0.5 * 800 * 9), 1e-5);
  EXPECT_NEAR(report.potential_energy, volume * 9.81 * (1000 * 0.5 + 800 * 1.5), 1e-5);
}

}  // namespace
}  // namespace pelagos::test
