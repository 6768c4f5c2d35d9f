// A value that is not finite is found in its step, and ends the run or is taken back.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "small_patch.hpp"
#include "world_access.hpp"

namespace pelagos {

namespace {

using test::CubeFile;
using test::patch_with_cube;
using test::small_patch;

constexpr std::size_t kVictim = 200;

void break_a_particle(World& world) {
  WorldTestAccess::fluid(world).particles.velocity[kVictim].x = std::numeric_limits<float>::quiet_NaN();
}

Scene restoring(Scene scene) {
  scene.on_fault = FaultPolicy::kRestore;
  return scene;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b, std::size_t count) {
  return std::memcmp(a.data(), b.data(), count * sizeof(T)) == 0;
}

void expect_same_bits(const FluidParticles& a, const FluidParticles& b) {
  ASSERT_EQ(a.count, b.count);
  EXPECT_TRUE(same_bits(a.position, b.position, a.count));
  EXPECT_TRUE(same_bits(a.velocity, b.velocity, a.count));
  EXPECT_TRUE(same_bits(a.acceleration, b.acceleration, a.count));
  EXPECT_TRUE(same_bits(a.density, b.density, a.count));
  EXPECT_TRUE(same_bits(a.density_pressure, b.density_pressure, a.count));
  EXPECT_TRUE(same_bits(a.divergence_pressure, b.divergence_pressure, a.count));
  EXPECT_TRUE(same_bits(a.id, b.id, a.count));
}

TEST(WorldFaults, StopEndsInTheStepOfTheFault) {
  World world(small_patch(), {2, nullptr, {}});
  for (int step = 0; step < 5; ++step) ASSERT_EQ(world.advance().fault, StepFault::kNone);
  break_a_particle(world);
  const WorldStep made = world.advance();
  EXPECT_EQ(made.report.not_finite, 1U);
  EXPECT_EQ(made.fault, StepFault::kFatal);
}

TEST(WorldFaults, RestoreBringsTheLastGoodStateBackBitByBit) {
  const CubeFile cube;
  World world(restoring(patch_with_cube(cube)), {2, nullptr, {}});
  for (int step = 0; step < 5; ++step) ASSERT_EQ(world.advance().fault, StepFault::kNone);
  const FluidParticles good = world.fluid().particles;
  const double time = world.time();
  const std::uint64_t frame = world.frame();
  const BodyState body = world.bodies().states()[0];
  break_a_particle(world);
  const WorldStep made = world.advance();
  EXPECT_EQ(made.report.not_finite, 1U);
  EXPECT_EQ(made.fault, StepFault::kRestored);
  EXPECT_FALSE(made.frame_reached);
  expect_same_bits(world.fluid().particles, good);
  EXPECT_EQ(world.time(), time);
  EXPECT_EQ(world.frame(), frame);
  EXPECT_EQ(world.bodies().states()[0].position, body.position);
}

TEST(WorldFaults, RestoreGoesOnWithSmallerStepsForASecond) {
  World world(restoring(small_patch()), {2, nullptr, {}});
  const std::size_t count = world.fluid().particles.count;
  for (int step = 0; step < 5; ++step) world.advance();
  break_a_particle(world);
  ASSERT_EQ(world.advance().fault, StepFault::kRestored);
  const double half = 0.5 * world.effort().max_step, until = world.time() + 1.0;
  while (world.time() < until) {
    const WorldStep made = world.advance();
    ASSERT_EQ(made.fault, StepFault::kNone);
    ASSERT_EQ(made.report.not_finite, 0U);
    ASSERT_LE(made.report.dt, half * (1.0 + 1e-9));  // cut into equal parts: rounding
  }
  EXPECT_EQ(world.fluid().particles.count, count);
  double longest = 0.0;
  for (int step = 0; step < 10; ++step) longest = std::max(longest, world.advance().report.dt);
  EXPECT_GT(longest, half) << "and then with the scene's own again";
}

TEST(WorldFaults, TheThirdFaultInARowIsFatal) {
  World world(restoring(small_patch()), {1, nullptr, {}});
  world.advance();
  for (const StepFault expected : {StepFault::kRestored, StepFault::kRestored, StepFault::kFatal}) {
    break_a_particle(world);
    EXPECT_EQ(world.advance().fault, expected);
  }
}

TEST(WorldFaults, ASecondWithoutFaultsEndsTheRow) {
  World world(restoring(small_patch()), {1, nullptr, {}});
  world.advance();
  for (int fault = 0; fault < 4; ++fault) {
    break_a_particle(world);
    ASSERT_EQ(world.advance().fault, StepFault::kRestored) << fault;
    const double until = world.time() + 1.01;
    while (world.time() < until) ASSERT_EQ(world.advance().fault, StepFault::kNone);
  }
}

TEST(WorldFaults, AFaultInTheFirstStepComesBackToTheStart) {
  World world(restoring(small_patch()), {1, nullptr, {}});
  const FluidParticles start = world.fluid().particles;
  break_a_particle(world);
  ASSERT_EQ(world.advance().fault, StepFault::kRestored);
  expect_same_bits(world.fluid().particles, start);
  EXPECT_EQ(world.time(), 0.0);
}

class WorldFaultsOfSolver : public testing::TestWithParam<SolverKind> {};

TEST_P(WorldFaultsOfSolver, GoOnFinite) {
  Scene scene = restoring(small_patch());
  scene.solver.kind = GetParam();
  scene.patch_edges[0] = PatchEdge::kPeriodic;  // images are made anew too
  World world(scene, {2, nullptr, {}});
  for (int step = 0; step < 5; ++step) ASSERT_EQ(world.advance().fault, StepFault::kNone);
  break_a_particle(world);
  ASSERT_EQ(world.advance().fault, StepFault::kRestored);
  for (int step = 0; step < 20; ++step) {
    const WorldStep made = world.advance();
    ASSERT_EQ(made.report.not_finite, 0U);
    ASSERT_EQ(made.report.outside, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, WorldFaultsOfSolver,
                         testing::Values(SolverKind::kHybrid, SolverKind::kDfsph, SolverKind::kPbf,
                                         SolverKind::kCorrected));

}  // namespace
}  // namespace pelagos
