#include <gtest/gtest.h>

#include <filesystem>

#include "../support/places.hpp"
#include "scene/read_scene.hpp"
#include "values/beaufort.hpp"
#include "values/lattice.hpp"

namespace pelagos {
namespace {

Scene load(const char* name) {
  const SceneResult result = read_scene_file(test::source_path("scenes/") + name);
  EXPECT_TRUE(result) << result.report();
  return result.scene.value_or(Scene{});
}

Box box(double x, double y, double z) { return {Eigen::Vector3d::Zero(), {x, y, z}}; }

TEST(Lattice, HoldsThePapersNumbersOfParticles) {
  // Sizes of the paper's sections VI.A to VI.C in units of L, d = 0.05 L, for L = 1 m and for the bridge's L = 20 m.
  for (const double unit : {1.0, 20.0}) {
    const double d = 0.05 * unit;
    EXPECT_EQ(particle_count(box(1.6 * unit, 1.5 * unit, 2.0 * unit), d), 35061) << "dam break";
    EXPECT_EQ(particle_count(box(5.0 * unit, 2.0 * unit, 0.5 * unit), d), 34749) << "wind waves";
    EXPECT_EQ(particle_count(box(3.0 * unit, 2.0 * unit, 0.8 * unit), d), 34515) << "lighthouse";
    EXPECT_EQ(particle_count(box(5.0 * unit, 3.0 * unit, 0.6 * unit), d), 64251) << "tanker, oil spill";
  }
}

TEST(Lattice, IsEmptyWhereThereIsNoRoomAndBoundedWhereThereIsTooMuch) {
  EXPECT_EQ(particle_count(box(1.0, 1.0, 0.19), 0.1), 0);
  EXPECT_EQ(particle_count(box(1.0, 1.0, 0.2), 0.1), 81);
  EXPECT_EQ(particle_count(box(1e300, 1e300, 1e300), 1e-3), 1e27);
}

TEST(Beaufort, SpeedsLieWithinTheirForce) {
  // Upper bounds of forces 0 to 11 at 10 m, m/s.
  const std::array<double, 12> upper{0.3, 1.6, 3.4, 5.5, 8.0, 10.8, 13.9, 17.2, 20.8, 24.5, 28.5, 32.7};
  for (std::size_t force = 0; force < 12; ++force) {
    EXPECT_LT(beaufort_speed(static_cast<int>(force)), upper[force]) << force;
    EXPECT_GT(beaufort_speed(static_cast<int>(force) + 1), upper[force]) << force;
  }
}

TEST(ShippedScenes, DamBreakIsThePapers) {
  const Scene scene = load("dam_break.scene");
  EXPECT_EQ(scene.name, "dam_break");
  EXPECT_EQ(particle_count(scene), 35061);
  EXPECT_EQ(scene.patch.size(), Eigen::Vector3d(5.0, 3.0, 5.0));
  EXPECT_FALSE(scene.wind);
}

TEST(ShippedScenes, PaperWindHasThePapersNumbers) {
  const Scene scene = load("paper_wind.scene");
  EXPECT_EQ(particle_count(scene), 34749);
  EXPECT_EQ(scene.solver.kind, SolverKind::kHybrid);
  ASSERT_TRUE(scene.wind);
  EXPECT_EQ(scene.wind->law, WindLaw::kPaper);
  EXPECT_EQ(scene.wind->velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));
  EXPECT_EQ(scene.wind->amplitude, 3.0);
  EXPECT_EQ(scene.wind->beta, 1.5);
  EXPECT_EQ(scene.wind->roughness, 0.01);
  ASSERT_TRUE(scene.wind->pulse);
  EXPECT_EQ(scene.wind->pulse->period, 10.0);
  EXPECT_EQ(scene.wind->pulse->width, 100.0);
}

TEST(ShippedScenes, WindWavesIsThePapers) {
  const Scene scene = load("wind_waves.scene");
  EXPECT_EQ(particle_count(scene), 34749);
  ASSERT_TRUE(scene.wind);
  EXPECT_EQ(scene.wind->velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));
  EXPECT_EQ(scene.wind->amplitude, 3.0);
  EXPECT_EQ(scene.wind->beta, 1.5);
  EXPECT_FALSE(scene.wind->pulse);
}

TEST(ShippedScenes, OilSpillIsThePapers) {
  const Scene scene = load("oil_spill.scene");
  ASSERT_TRUE(scene.oil);
  EXPECT_EQ(scene.water.rest_density, 1027.0);
  EXPECT_EQ(scene.oil->properties.density, 800.0);
  EXPECT_EQ(particle_count(scene), 64251 + 10179);  // the paper's 64.3k and about 10k
  ASSERT_TRUE(scene.wind);
  EXPECT_EQ(scene.wind->velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));
}

TEST(ShippedScenes, StillWaterIsSmall) { EXPECT_EQ(particle_count(load("still_water.scene")), 4000); }

TEST(ShippedScenes, BridgeCarriesTheOwnShip) {
  const Scene scene = load("bridge.scene");
  EXPECT_EQ(particle_count(scene), 24000);
  EXPECT_EQ(scene.particle_spacing, 1.0);
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].id, 1u);
  EXPECT_EQ(scene.bodies[0].drive, BodyDrive::kPose);
  EXPECT_TRUE(std::filesystem::is_regular_file(scene.bodies[0].mesh_file));
  ASSERT_TRUE(scene.wind);
  EXPECT_NEAR(scene.wind->velocity.norm(), beaufort_speed(5), 1e-12);  // sin and cos round
  EXPECT_NEAR(wind_from_deg(scene.wind->velocity), 250.0, 1e-9);
  EXPECT_EQ(scene.far_sea.beaufort, 5);
}

TEST(ShippedScenes, StormRisesTellsItsStory) {
  const Scene scene = load("storm_rises.scene");
  ASSERT_EQ(scene.events.size(), 4U);
  const auto rise = std::get<SetWind>(scene.events[0].command), turn = std::get<SetWind>(scene.events[2].command);
  EXPECT_NEAR(*rise.wind.speed, beaufort_speed(8), 1e-12);
  EXPECT_TRUE(std::get<SetWind>(scene.events[1].command).wind.pulse);
  EXPECT_EQ(turn.wind.from_deg, 315.0);
  EXPECT_FALSE(turn.wind.speed) << "stays";
  EXPECT_FALSE(turn.wind.pulse);
  EXPECT_TRUE(std::holds_alternative<ClearWind>(scene.events[3].command));
}

TEST(ShippedScenes, LighthouseIsThePapersInMetresOfTwentyALength) {
  const Scene scene = load("lighthouse.scene");
  EXPECT_EQ(particle_count(scene), 34515);
  EXPECT_EQ(scene.patch.size(), Eigen::Vector3d(100.0, 60.0, 100.0));
  ASSERT_TRUE(scene.wind);
  EXPECT_EQ(scene.wind->velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].drive, BodyDrive::kStatic);
}

TEST(ShippedScenes, TankerIsThePapersInMetresOfTwentyALength) {
  const Scene scene = load("tanker.scene");
  EXPECT_EQ(particle_count(scene), 64251);
  EXPECT_EQ(scene.patch.size(), Eigen::Vector3d(120.0, 60.0, 100.0));
  ASSERT_TRUE(scene.wind);
  EXPECT_EQ(scene.wind->velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].id, 1u) << "the own ship";
}

TEST(ShippedScenes, EverySceneLoads) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_path("scenes"))) {
    if (entry.path().extension() != ".scene") continue;
    ++scenes;
    const SceneResult result = read_scene_file(entry.path());
    EXPECT_TRUE(result) << result.report();
  }
  EXPECT_GE(scenes, 23);
}

}  // namespace
}  // namespace pelagos
