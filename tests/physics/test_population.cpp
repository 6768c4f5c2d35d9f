#include <gtest/gtest.h>

#include <set>

#include "oil_scene.hpp"

namespace pelagos::test {
namespace {

// Particles that come and go between steps.

constexpr double kSpacing = 0.05;

FluidParameters small_patch(Scheme scheme, Edge edge_x = Edge::kWall) {
  FluidParameters parameters = with_scheme(patch_parameters({0.55, 0.5, 1.0}, kSpacing), scheme);
  parameters.edges[0] = edge_x;
  parameters.oil = PhaseParameters{900.0, std::max(0.1, 900.0 * parameters.viscosity)};
  return parameters;
}

WaterScene filled(Scheme scheme, int threads = 2, Edge edge_x = Edge::kWall) {
  return {threads, small_patch(scheme, edge_x), lattice({10, 9, 6}, kSpacing, {kSpacing, kSpacing, kSpacing})};
}

/// A patch of oil above the water.
std::vector<Float4> patch(float height) {
  return lattice({4, 4, 1}, kSpacing, {0.15, 0.15, static_cast<double>(height)});
}

void expect_sound(const FluidParticles& p, std::size_t count) {
  ASSERT_EQ(p.count, count);
  std::set<std::uint32_t> ids(p.id.begin(), p.id.begin() + static_cast<std::ptrdiff_t>(count));
  EXPECT_EQ(ids.size(), count);
  for (const std::size_t size : {p.position.size(), p.velocity.size(), p.acceleration.size(), p.density.size(),
                                 p.density_pressure.size(), p.divergence_pressure.size(), p.id.size()})
    ASSERT_GE(size, padded_count(count));
  for (std::size_t i = count; i < padded_count(count); ++i) {
    ASSERT_GT(p.position[i].x, 1e8F) << "padding is a far dummy";
    ASSERT_EQ(p.velocity[i].x, 0.0F);
  }
}

class Population : public testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Population,
                         testing::Values(Scheme::kHybrid, Scheme::kDfsph, Scheme::kPbf, Scheme::kCorrected));

TEST_P(Population, GrowsAndShrinksWhileTheWaterMoves) {
  for (const Edge edge : {Edge::kWall, Edge::kMirror, Edge::kPeriodic}) {
    WaterScene water = filled(GetParam(), 2, edge);
    const std::size_t start = water.state.particles.count;
    for (int n = 0; n < 5; ++n) static_cast<void>(water.step(water.largest_step()));
    for (int n = 0; n < 6; ++n) {
      const std::vector<Float4> points = patch(0.4F + 0.05F * static_cast<float>(n)), still(points.size());
      add_particles(water.state, points, still, kOilPhase);
      expect_sound(water.state.particles, start + 16U * static_cast<std::size_t>(n + 1));
      for (int k = 0; k < 12; ++k) {
        const StepReport report = water.step(water.largest_step());
        ASSERT_EQ(report.not_finite, 0U);
        ASSERT_EQ(report.outside, 0U);
      }
    }
    EXPECT_EQ(water.state.oil_count, 96U);
    const std::size_t removed = remove_particles(water.pool, water.state, [&](std::size_t i) {
      return water.state.particles.phase[i] == kOilPhase && water.state.particles.position[i].y < 0.25F;
    });
    EXPECT_GT(removed, 0U);
    EXPECT_LT(removed, 96U);
    expect_sound(water.state.particles, start + 96 - removed);
    for (int k = 0; k < 5; ++k) ASSERT_EQ(water.step(water.largest_step()).not_finite, 0U);
    EXPECT_EQ(water.state.oil_count, 96 - removed);
    expect_sound(water.state.particles, start + 96 - removed);
  }
}

TEST(PopulationDetails, NewcomersStartAsAskedBehindTheOthers) {
  WaterScene water = filled(Scheme::kHybrid);
  static_cast<void>(water.step(water.largest_step()));
  const std::size_t start = water.state.particles.count;
  const std::vector<std::uint32_t> ids = water.state.particles.id;
  const std::vector<Float4> velocities(2, Float4{1, 2, 3, 9});
  add_particles(water.state, std::vector<Float4>{{0.1F, 0.2F, 0.7F, 5}, {0.2F, 0.2F, 0.7F, 5}}, velocities, kOilPhase);
  const FluidParticles& p = water.state.particles;
  for (std::size_t i = 0; i < start; ++i) ASSERT_EQ(p.id[i], ids[i]);
  for (std::size_t i = start; i < start + 2; ++i) {
    EXPECT_EQ(p.id[i], i);
    EXPECT_EQ(p.phase[i], kOilPhase);
    EXPECT_EQ(p.position[i].y, 0.2F);
    EXPECT_EQ(p.position[i].w, 0.0F);
    EXPECT_EQ(p.velocity[i].z, 3.0F);
    EXPECT_EQ(p.velocity[i].w, 0.0F);
    EXPECT_EQ(p.acceleration[i].z, -9.81F);
    EXPECT_EQ(p.density_pressure[i], 0.0F);
    EXPECT_EQ(p.divergence_pressure[i], 0.0F);
    EXPECT_EQ(p.density[i], 1.0F);
  }
}

TEST(PopulationDetails, IdsAreNeverGivenTwice) {
  WaterScene water = filled(Scheme::kCorrected);
  const auto count = static_cast<std::uint32_t>(water.state.particles.count);
  const std::vector<Float4> one{{0.3F, 0.3F, 0.8F, 0}}, still(1);
  add_particles(water.state, one, still, kOilPhase);
  EXPECT_EQ(
      remove_particles(water.pool, water.state, [&](std::size_t i) { return water.state.particles.id[i] == count; }),
      1U);
  add_particles(water.state, one, still, kWaterPhase);
  EXPECT_EQ(water.state.particles.id[count], count + 1);
}

TEST(PopulationDetails, NoneAndAllAreNumbersToo) {
  WaterScene water = filled(Scheme::kCorrected);
  const std::size_t start = water.state.particles.count;
  add_particles(water.state, {}, {}, kOilPhase);
  EXPECT_EQ(water.state.particles.count, start);
  EXPECT_EQ(remove_particles(water.pool, water.state, [](std::size_t) { return false; }), 0U);
  EXPECT_EQ(remove_particles(water.pool, water.state, [](std::size_t) { return true; }), start);
  EXPECT_EQ(water.state.particles.count, 0U);
  EXPECT_EQ(water.step(0.005).not_finite, 0U);
  const std::vector<Float4> points = patch(0.5F), still(points.size());
  add_particles(water.state, points, still, kOilPhase);
  for (int n = 0; n < 100; ++n) ASSERT_EQ(water.step(0.005).outside, 0U);
  EXPECT_LT(mean_height_of(water.state, kOilPhase), 0.2);  // fell from 0.5 m and splashed
}

TEST(PopulationDetails, WaterComesWithoutAnyOil) {
  FluidParameters parameters = small_patch(Scheme::kCorrected);
  parameters.oil.reset();
  WaterScene water(2, parameters, lattice({10, 9, 6}, kSpacing, {kSpacing, kSpacing, kSpacing}));
  const std::vector<Float4> points = patch(0.5F), still(points.size());
  add_particles(water.state, points, still, kWaterPhase);
  EXPECT_TRUE(water.state.particles.phase.empty());
  for (int n = 0; n < 20; ++n) ASSERT_EQ(water.step(0.005).not_finite, 0U);
}

TEST_P(Population, SameBitsForOneAndThreeThreads) {
  const auto history = [&](int threads) {
    WaterScene water = filled(GetParam(), threads);
    std::vector<std::uint64_t> hashes;
    const std::vector<Float4> points = patch(0.4F), still(points.size(), Float4{0.1F, 0, 0, 0});
    for (int n = 0; n < 30; ++n) {
      if (n % 10 == 3) add_particles(water.state, points, still, kOilPhase);
      if (n % 10 == 8)
        static_cast<void>(remove_particles(water.pool, water.state, [&](std::size_t i) {
          return water.state.particles.phase[i] == kOilPhase && water.state.particles.id[i] % 3 == 0;
        }));
      static_cast<void>(water.step(water.largest_step()));
      hashes.push_back(state_hash(water.state.particles));
    }
    return hashes;
  };
  EXPECT_EQ(history(1), history(3));
}

}  // namespace
}  // namespace pelagos::test
