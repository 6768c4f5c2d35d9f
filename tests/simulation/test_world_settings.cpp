// What a scene says about how its water is computed reaches the physics and holds there.

#include <gmock/gmock.h>

#include "give.hpp"
#include "simulation/world.hpp"
#include "small_patch.hpp"

namespace pelagos {
namespace {

using test::CubeFile;
using test::patch_with_cube;
using test::small_patch;
using testing::HasSubstr;

class WorldSupport : public testing::TestWithParam<double> {};

TEST_P(WorldSupport, StillWaterStaysInItsPatch) {
  Scene scene = small_patch();
  scene.support_radius = GetParam();
  World world(scene, {2, nullptr, {}});
  EXPECT_EQ(world.fluid().parameters.support_radius, GetParam() * scene.particle_spacing);
  double peak = 0.0;
  for (int step = 0; step < 100; ++step) {
    const StepReport report = world.advance().report;
    ASSERT_EQ(report.not_finite, 0U);
    ASSERT_EQ(report.outside, 0U);
    ASSERT_EQ(report.long_rows, 0U) << "rows must fit the fast search";
    peak = std::max(peak, report.density_error);
  }
  EXPECT_LT(peak, 0.01);  // far above the tolerance of 3e-4, far below the 19 % that a fresh lattice reads at 1.4
}

INSTANTIATE_TEST_SUITE_P(Spacings, WorldSupport, testing::Values(1.4, 1.5, 2.0, 2.5));

TEST(WorldEffort, IsTheScenesUntilItIsSet) {
  Scene scene = small_patch();
  scene.time_step.max_step = 0.004;
  scene.solver.divergence.tolerance = 2e-4;
  World world(scene, {1, nullptr, {}});
  EXPECT_EQ(world.effort(), (Effort{0.004, 3e-4, 2e-4}));
  EXPECT_LE(world.advance().report.dt, 0.004);
  const Effort cheaper{0.008, 5e-3, 5e-3};
  static_cast<void>(test::give(world, SetEffort{cheaper, ""}));
  EXPECT_EQ(world.effort(), cheaper);
  EXPECT_GT(world.advance().report.dt, 0.004) << "still water: nothing else shortens the step";
}

TEST(WorldEffort, SameBitsForOneTwoAndSevenThreadsAndOnReplay) {
  // What a governor decided at which step, played again.
  World one(small_patch(), {1, nullptr, {}}), two(small_patch(), {2, nullptr, {}}),
      seven(small_patch(), {7, nullptr, {}});
  const Effort exact = one.effort();
  for (int step = 0; step < 40; ++step) {
    for (World* world : {&one, &two, &seven}) {
      if (step == 10)
        static_cast<void>(test::give(
            *world, SetEffort{{1.3 * exact.max_step, exact.density_tolerance, exact.divergence_tolerance}, ""}));
      if (step == 20) static_cast<void>(test::give(*world, SetEffort{{1.3 * exact.max_step, 2e-3, 2e-3}, ""}));
      if (step == 30) static_cast<void>(test::give(*world, SetEffort{exact, ""}));
      world->advance();
    }
    ASSERT_EQ(state_hash(one.fluid().particles), state_hash(two.fluid().particles)) << step;
    ASSERT_EQ(state_hash(one.fluid().particles), state_hash(seven.fluid().particles)) << step;
  }
}

TEST(WorldEffort, AToleranceOutOfReachIsReportedInEveryStep) {
  Scene scene = small_patch();
  scene.solver.kind = SolverKind::kHybrid;  // water at rest between mirrors needs hardly any iteration
  scene.solver.divergence = {1e-6, 2, 3};
  World world(scene, {1, nullptr, {}});
  for (int step = 0; step < 10; ++step) {
    const SolveReport solve = world.advance().report.divergence;
    EXPECT_FALSE(solve.converged);
    EXPECT_EQ(solve.iterations, 3);
    EXPECT_GT(solve.residual, 1e-6);
  }
}

TEST(WorldEdges, RefusesABodyNearAPeriodicFace) {
  const CubeFile cube;  // 1 m, at (2.5, 2, 0.9) in a patch of 5 x 4 m; the support radius is 0.5 m
  Scene scene = patch_with_cube(cube);
  scene.patch_edges[0] = PatchEdge::kPeriodic;
  EXPECT_NO_THROW(World(scene, {1, nullptr, {}}));
  scene.bodies[0].position.x() = 1.01;  // its face at 0.51
  EXPECT_NO_THROW(World(scene, {1, nullptr, {}}));
  scene.bodies[0].position.x() = 0.99;
  try {
    const World world(scene, {1, nullptr, {}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("periodic face across x; allowed: at least a support radius, 0.5"));
  }
  scene.patch_edges[0] = PatchEdge::kWall;
  EXPECT_NO_THROW(World(scene, {1, nullptr, {}}));
}

TEST(WorldEdges, PeriodicWaterKeepsItsMotionAndItsParticles) {
  Scene scene = small_patch();
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kMirror, PatchEdge::kWall};
  World world(scene, {2, nullptr, {}});
  EXPECT_EQ(world.fluid().particles.count, 20U * 16U * 5U);
  EXPECT_NEAR(world.water_level(), 5 * 0.25, 1e-12);
  for (int step = 0; step < 50; ++step) {
    const StepReport report = world.advance().report;
    ASSERT_EQ(report.not_finite, 0U);
    ASSERT_EQ(report.outside, 0U);
  }
}

}  // namespace
}  // namespace pelagos
