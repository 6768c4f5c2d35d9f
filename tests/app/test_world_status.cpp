// What the status tells before there is a world, and while its water settles.

#include "world_status.hpp"

#include <gtest/gtest.h>

namespace pelagos {
namespace {

Scene windy_channel() {
  Scene scene;
  scene.name = "channel";
  scene.patch = {{0, 0, 0}, {2, 2, 1}};
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kWall, PatchEdge::kWall};
  scene.particle_spacing = 0.2;
  scene.water.blocks = {{{0, 0, 0}, {2, 2, 0.6}}};
  scene.water.settle_steps = 20;
  scene.wind = WindSettings{};
  scene.wind->velocity = {9.0, 0.0, 0.0};
  scene.current = CurrentSettings{};
  scene.current->velocity = {1.0, 0.0, 0.0};
  scene.far_sea.waves = {{.amplitude = 0.5, .length = 40.0}};
  scene.oil.emplace().model = OilModel::kSlick;
  scene.oil->properties = find_oil("medium crude").value();
  return scene;
}

void expect_values_of_scene(const ServerStatus& status, const Scene& scene) {
  ASSERT_TRUE(status.wind && status.current && status.sea.highest);
  EXPECT_EQ(status.scene, "channel");
  EXPECT_EQ(status.wind->velocity, scene.wind->velocity);
  EXPECT_EQ(status.current->velocity, scene.current->velocity);
  EXPECT_TRUE(status.moves_water[0]);
  EXPECT_FALSE(status.moves_water[1]);
  EXPECT_EQ(status.sea.waves, 1u);
  EXPECT_DOUBLE_EQ(status.effort.density_tolerance, scene.solver.density.tolerance);
  EXPECT_DOUBLE_EQ(status.effort.divergence_tolerance, scene.solver.divergence.tolerance);
  EXPECT_GT(status.effort.max_step, 0.0);
}

TEST(WorldStatus, TellsTheScenesValuesBeforeItsWaterIsPlaced) {
  const Scene scene = windy_channel();
  const ServerStatus status = starting_status(scene, make_scene_sea(scene));
  EXPECT_TRUE(status.starting);
  EXPECT_TRUE(status.oil.has_value());
  expect_values_of_scene(status, scene);
}

TEST(WorldStatus, TellsTheWorldsValuesWhileItsWaterSettles) {
  const Scene scene = windy_channel();
  ServerStatus placed = starting_status(scene, make_scene_sea(scene));
  std::optional<Air> air;
  WorldOptions options;
  bool settling = false;
  options.placed = [&](const World& world) {
    EXPECT_FALSE(settling);
    EXPECT_TRUE(world.spill().has_value());
    fill_from(world, placed);
    air = world.air();
  };
  options.progress = [&](double) { return settling = true; };
  const World world(scene, options);
  ASSERT_TRUE(settling);
  expect_values_of_scene(placed, scene);
  EXPECT_EQ(placed.particles, world.fluid().particles.count);
  EXPECT_EQ(placed.effort, world.effort());
  ASSERT_TRUE(air);
  const Eigen::Vector3d mast(1.0, 1.0, 10.6);
  EXPECT_EQ(air->velocity_at(mast, 0.0), world.air()->velocity_at(mast, 0.0));
  EXPECT_NEAR((starting_air(scene)->velocity_at(mast, 0.0) - air->velocity_at(mast, 0.0)).norm(), 0.0, 1e-9)
      << "without bodies the water is at rest at the top of its block";
}

TEST(WorldStatus, HasNoAirWithoutWind) {
  Scene scene = windy_channel();
  scene.wind.reset();
  EXPECT_FALSE(starting_air(scene));
  EXPECT_FALSE(starting_status(scene, make_scene_sea(scene)).wind);
}

}  // namespace
}  // namespace pelagos
