#include <gtest/gtest.h>

#include "simulation/fluid_setup.hpp"
#include "simulation/world.hpp"
#include "small_patch.hpp"

namespace pelagos {
namespace {

/// The patch with a slick of 10 x 10 x 2 particles on it.
Scene patch_with_oil() {
  Scene scene = test::small_patch();
  scene.oil = OilSettings{*find_oil("diesel"), {{{1.25, 1.0, 1.25}, {3.75, 3.5, 1.75}}}};
  return scene;
}

TEST(WorldOil, StartsWithItsBlocksAndPropertiesAndPublishesThePhase) {
  World world(patch_with_oil(), {2, nullptr, {}});
  EXPECT_EQ(world.fluid().particles.count, 1600U + 200U);
  ASSERT_TRUE(world.fluid().parameters.oil);
  EXPECT_EQ(world.fluid().parameters.oil->rest_density, find_oil("diesel")->density);
  EXPECT_EQ(world.fluid().parameters.oil->viscosity, find_oil("diesel")->viscosity);
  Snapshot snapshot;
  for (int frame = 0; frame < 3;) {
    WorldStep step = world.advance();
    ASSERT_EQ(step.report.not_finite, 0U);
    if (!step.frame_reached) continue;
    ++frame;
    world.take_frame(snapshot, step.report);
    std::size_t oil = 0;
    for (const SurfaceParticle& particle : snapshot.particles) oil += particle.phase == kOilPhase ? 1 : 0;
    EXPECT_EQ(oil, 200U) << "all of the oil travels";
    EXPECT_LT(oil, snapshot.particles.size());
  }
}

TEST(WorldOil, IsAtLeastAsViscousAsWaterThatHasToBe) {
  Scene scene = patch_with_oil();
  scene.solver = default_solver(SolverKind::kHybrid);
  const FluidParameters parameters = fluid_parameters(scene, patch_frame(scene));
  EXPECT_GT(parameters.viscosity, 0.0);
  EXPECT_DOUBLE_EQ(parameters.oil->viscosity, find_oil("diesel")->density * parameters.viscosity);
  scene.oil->properties.viscosity = 1000.0;
  EXPECT_EQ(fluid_parameters(scene, patch_frame(scene)).oil->viscosity, 1000.0);
}

TEST(WorldOil, AnEntryWithoutBlocksChangesNoBit) {
  Scene scene = test::small_patch();
  World without(scene, {1, nullptr, {}});
  scene.oil = OilSettings{*find_oil("bunker C"), {}};
  World with(scene, {1, nullptr, {}});
  for (int n = 0; n < 10; ++n) {
    without.advance();
    with.advance();
    ASSERT_EQ(state_hash(with.fluid().particles), state_hash(without.fluid().particles)) << n;
  }
}

}  // namespace
}  // namespace pelagos
