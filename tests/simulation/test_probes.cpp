#include "give.hpp"
#include "simulation/probes.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "simulation/world.hpp"
#include "small_patch.hpp"
#include "surface/water_columns.hpp"
#include "world_access.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;
using testing::Optional;

/// Water 2 m deep, d = 0.25 m.
Scene deep_patch() {
  Scene scene = test::small_patch();
  scene.water.blocks[0].max.z() = 2.0;
  return scene;
}

ProbeSettings probe_at(double x, double y, std::uint32_t id = 1) {
  ProbeSettings probe;
  probe.id = id;
  probe.name = "p";
  probe.position = {x, y, 0.0};
  return probe;
}

ProbeReading read_one(const World& world) {
  const std::vector<ProbeReading> readings = world.read_probes();
  EXPECT_EQ(readings.size(), 1U);
  return readings.empty() ? ProbeReading{} : readings[0];
}

TEST(Probes, StillWaterReadsItsVolumeOverItsArea) {
  Scene scene = deep_patch();
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kPeriodic, PatchEdge::kMirror};  // no walls that take room
  scene.probes = {probe_at(2.5, 2.0)};
  const World world(scene, {1, nullptr, {}});
  const double d = scene.particle_spacing;
  const double level = static_cast<double>(world.fluid().particles.count) * d * d * d / (5.0 * 4.0);
  const ProbeReading reading = read_one(world);
  EXPECT_TRUE(reading.wet);
  EXPECT_NEAR(reading.height, level, 0.02 * d);
  EXPECT_GT(reading.normal.z(), 0.99);
}

TEST(Probes, FollowASlopeAndItsNormal) {
  Scene scene = deep_patch();
  scene.probes = {probe_at(2.5, 2.0)};
  World world(scene, {1, nullptr, {}});
  const ProbeReading before = read_one(world);
  for (Float4& p : WorldTestAccess::fluid(world).particles.position)
    p.z += 0.1F * (p.x + static_cast<float>(world.patch().origin.x()) - 2.5F) + 0.125F;
  const ProbeReading after = read_one(world);
  EXPECT_NEAR(after.height - before.height, 0.125, 0.02);
  EXPECT_NEAR(after.normal.x() / after.normal.z() - before.normal.x() / before.normal.z(), -0.1, 0.02);
  EXPECT_NEAR(after.normal.y() / after.normal.z() - before.normal.y() / before.normal.z(), 0.0, 0.02);
}

TEST(Probes, ReadTheVelocityAtTheSurfaceOrWhereTheyAre) {
  Scene scene = deep_patch();
  scene.probes = {probe_at(2.5, 2.0, 1), probe_at(2.5, 2.0, 2), probe_at(2.5, 2.0, 3)};
  scene.probes[1].at_surface = scene.probes[2].at_surface = false;
  scene.probes[1].position.z() = 1.0;
  scene.probes[2].position.z() = 2.9;  // in the air: that of the surface
  World world(scene, {1, nullptr, {}});
  FluidParticles& p = WorldTestAccess::fluid(world).particles;
  for (std::size_t i = 0; i < p.count; ++i)
    p.velocity[i] = {p.position[i].z + static_cast<float>(world.patch().origin.z()), -0.2F, 0.0F, 0.0F};
  const std::vector<ProbeReading> readings = world.read_probes();
  ASSERT_EQ(readings.size(), 3U);
  EXPECT_NEAR(readings[0].velocity.x(), readings[0].height, 0.3);  // the mean of the topmost layers
  EXPECT_NEAR(readings[1].velocity.x(), 1.0, 0.05);
  EXPECT_NEAR(readings[1].velocity.y(), -0.2, 1e-5);
  EXPECT_EQ(readings[2].velocity, readings[0].velocity);
}

TEST(Probes, ReadTheWindWhereTheyAreAndNothingWithoutWind) {
  Scene scene = deep_patch();
  ProbeSettings mast = probe_at(1.0, 1.0);
  mast.position.z() = 12.0;
  scene.probes = {mast};
  EXPECT_EQ(read_one(World(scene, {})).air, std::nullopt);
  scene.wind.emplace();
  scene.wind->velocity = {8.0, 0.0, 0.0};
  scene.wind->amplitude = 0.0;
  World world(scene, {});
  const ProbeReading reading = read_one(world);
  ASSERT_TRUE(reading.air.has_value());
  EXPECT_EQ(*reading.air, world.air()->velocity_at(mast.position, 0.0));
  EXPECT_NEAR(reading.air->x(), 8.0, 0.2);  // 10 m over the level of 2 m the log profile has its mean
}

TEST(Probes, SayWhereThereIsNoWater) {
  Scene scene = deep_patch();
  scene.water.blocks[0].max.x() = 2.0;
  scene.water.settle_steps = 0;
  scene.probes = {probe_at(1.0, 2.0, 1), probe_at(4.0, 2.0, 2)};
  const World world(scene, {1, nullptr, {}});
  EXPECT_TRUE(world.read_probes()[0].wet);
  EXPECT_FALSE(world.read_probes()[1].wet);
}

TEST(Probes, PlacesFarAwayOrNowhereAreDryAndCostNothing) {
  const World world(deep_patch(), {1, nullptr, {}});
  const Eigen::Vector2d middle = (Eigen::Vector3d(2.5, 2.0, 0.0) - world.patch().origin).head<2>();
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  const std::vector<SurfacePlace> places{{middle, {}}, {{9e4, -9e4}, {}}, {{nowhere, 0.0}, {}}};
  TaskPool pool(1);
  const WaterColumns columns(pool, ColumnWater::of(world.fluid()));
  EXPECT_TRUE(columns.read(places[0]).wet);
  EXPECT_FALSE(columns.read(places[1]).wet) << "cells up to there would take terabytes";
  EXPECT_FALSE(columns.read(places[2]).wet);
}

TEST(Probes, GoWithTheirBody) {
  const test::CubeFile cube;
  Scene scene = test::patch_with_cube(cube);
  scene.bodies[0].orientation = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ());  // forward is north
  scene.probes = {probe_at(1.25, 0.0)};
  scene.probes[0].body = 1;
  scene.probes[0].at_surface = false;
  const World world(scene, {1, nullptr, {}});
  const ProbeReading reading = read_one(world);
  EXPECT_TRUE(reading.position.isApprox(Eigen::Vector3d(2.5, 3.25, 0.9), 1e-9)) << reading.position.transpose();
  EXPECT_TRUE(reading.wet);
}

TEST(Probes, AreAddedReplacedAndRemovedByCommands) {
  World world(test::small_patch(), {1, nullptr, {}});
  EXPECT_TRUE(world.read_probes().empty());
  EXPECT_EQ(test::give(world, SetProbe{probe_at(1.0, 1.0, 7)}), std::nullopt);
  EXPECT_EQ(test::give(world, SetProbe{probe_at(2.0, 1.0, 7)}), std::nullopt);
  EXPECT_EQ(read_one(world).position.x(), 2.0);
  StepReport report;
  Snapshot snapshot;
  world.take_frame(snapshot, report);
  ASSERT_EQ(snapshot.probes.size(), 1U);
  EXPECT_EQ(snapshot.probes[0].id, 7U);
  EXPECT_EQ(test::give(world, RemoveProbe{7}), std::nullopt);
  world.take_frame(snapshot, report);
  EXPECT_TRUE(snapshot.probes.empty());
}

TEST(Probes, AreRefusedWhereTheyCannotBe) {
  World world(test::small_patch(), {1, nullptr, {}});
  ProbeSettings on_nobody = probe_at(1.0, 1.0);
  on_nobody.body = 9;
  EXPECT_THAT(test::give(world, SetProbe{on_nobody}), Optional(HasSubstr("no body 9; allowed: ")));
  EXPECT_THAT(test::give(world, SetProbe{probe_at(6.0, 1.0)}), Optional(HasSubstr("(6, 1) m is outside the patch")));
  EXPECT_THAT(test::give(world, RemoveProbe{3}), Optional(HasSubstr("no probe 3")));
  for (std::uint32_t id = 1; id <= kMostProbes; ++id)
    ASSERT_EQ(test::give(world, SetProbe{probe_at(1.0, 1.0, id)}), std::nullopt);
  EXPECT_THAT(test::give(world, SetProbe{probe_at(1.0, 1.0, kMostProbes + 1)}), Optional(HasSubstr("256")));
  EXPECT_EQ(test::give(world, SetProbe{probe_at(2.0, 1.0, 5)}), std::nullopt) << "replacing is no more";
}

}  // namespace
}  // namespace pelagos
