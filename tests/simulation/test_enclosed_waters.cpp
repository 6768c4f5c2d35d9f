#include "simulation/enclosed_waters.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "simulation/world.hpp"

namespace pelagos {
namespace {

constexpr PatchEdges kMirrored{PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};

/// 4 x 2 x 3 m with smooth faces, d = 0.125 m, with water up to `depth` from x = 0 to `end`.
Scene channel(double end, double depth) {
  Scene scene;
  scene.name = "channel";
  scene.particle_spacing = 0.125;
  scene.patch = {{0, 0, 0}, {4, 2, 3}};
  scene.patch_edges = kMirrored;
  scene.water.blocks = {{{0, 0, 0}, {end, 2, depth}}};
  return scene;
}

void add_block(Scene& scene, const Eigen::Vector3d& min, const Eigen::Vector3d& max,
               BodyDrive drive = BodyDrive::kStatic) {
  BodySettings body;
  body.id = static_cast<std::uint32_t>(scene.bodies.size() + 1);
  body.name = "block";
  body.primitive = BoxShape{max - min};
  body.position = 0.5 * (min + max);
  body.drive = drive;
  if (drive == BodyDrive::kFree) body.mass.density = 500.0;
  scene.bodies.push_back(body);
}

double level_of(const Scene& scene) { return World(scene, {1, nullptr, {}}).water_level(); }

/// By their surfaces, the largest first.
std::vector<EnclosedWater> waters_of(const Scene& scene) {
  const World world(scene, {1, nullptr, {}});
  TaskPool pool(1);
  const FluidParticles& p = world.fluid().particles;
  std::vector<EnclosedWater> waters =
      find_enclosed_waters(pool, scene, world.bodies(), std::span(p.position).first(p.count), world.patch());
  std::sort(waters.begin(), waters.end(),
            [](const EnclosedWater& a, const EnclosedWater& b) { return a.surface > b.surface; });
  return waters;
}

TEST(RestLevel, WithoutBodiesSpreadsTheBlocksOverTheFloor) {
  EXPECT_DOUBLE_EQ(level_of(channel(4.0, 1.0)), 1.0);
  EXPECT_DOUBLE_EQ(level_of(channel(2.0, 1.0)), 0.5);
}

TEST(RestLevel, IsThatOfTheWaterBesideAQuay) {
  for (const double end : {4.0, 2.0}) {  // the block goes on through the quay, or ends at it
    Scene scene = channel(end, 1.0);
    add_block(scene, {2, -0.5, -0.5}, {4.5, 2.5, 2});
    EXPECT_NEAR(level_of(scene), 1.0, 1e-12) << end;
  }
}

TEST(RestLevel, IsTheSameForSampledWalls) {
  Scene scene = channel(4.0, 1.0);
  scene.patch_edges = kWallsAround;
  const double empty = level_of(scene);
  add_block(scene, {2, -0.5, -0.5}, {4.5, 2.5, 2});
  EXPECT_NEAR(level_of(scene), empty, 1e-12);
  scene.water.blocks[0].max.x() = 2.0;
  EXPECT_NEAR(level_of(scene), empty, 1e-12);
}

TEST(RestLevel, CountsTheRoomUnderABodyThatHangs) {
  // 6 m^3 in the left half fill the 0.5 m under the body on the right, then the left: 0.5 x 8 + (level - 0.5) x 4.
  Scene scene = channel(2.0, 1.5);
  add_block(scene, {2, -0.5, 0.5}, {4.5, 2.5, 4});
  EXPECT_NEAR(level_of(scene), 1.0, 1e-9);
}

TEST(RestLevel, IsNotChangedByAHullAfloat) {
  Scene scene = channel(4.0, 1.0);
  add_block(scene, {1, 0.5, 0.75}, {2, 1.5, 1.25}, BodyDrive::kFree);
  EXPECT_NEAR(level_of(scene), 1.0, 1e-12);
}

TEST(RestLevel, FollowsASlopingBed) {
  const std::string path = testing::TempDir() + "pelagos_slope_" + std::to_string(getpid()) + ".obj";
  std::ofstream(path) << "v -1 -1 -0.25\nv 5 -1 1.25\nv 5 3 1.25\nv -1 3 -0.25\nf 1 2 3\nf 1 3 4\n";
  // The bed rises from 0 at x = 0 to 1 at x = 4. 5 m^3 above its first half: 2 (4 level - 2) = 5.
  Scene scene = channel(2.0, 1.5);
  BodySettings bed;
  bed.id = 1;
  bed.name = "bed";
  bed.mesh_file = path;
  bed.drive = BodyDrive::kStatic;
  bed.open = true;
  scene.bodies = {bed};
  EXPECT_NEAR(level_of(scene), 1.125, 0.3 * 0.125);  // places along the dry slope are whole
  std::remove(path.c_str());
}

TEST(RestLevel, CountsOilToo) {
  Scene scene = channel(2.0, 0.5);
  scene.oil.emplace();
  scene.oil->properties.density = 900.0;
  scene.oil->properties.viscosity = 0.1;
  scene.oil->blocks = {{{0, 0, 0.5}, {2, 2, 1}}};
  add_block(scene, {2, -0.5, -0.5}, {4.5, 2.5, 2});
  EXPECT_NEAR(level_of(scene), 1.0, 1e-12);
}

TEST(RestLevel, OfSeveralWatersIsThatOfTheLargestSurface) {
  // A lock on the right, behind a gate of a thousandth of a metre: 0.5 m higher.
  Scene scene = channel(2.75, 1.0);
  scene.water.blocks.push_back({{2.75, 0, 0}, {4, 2, 1.5}});
  add_block(scene, {2.7495, -0.5, -0.5}, {2.7505, 2.5, 2});
  EXPECT_NEAR(level_of(scene), 1.0, 1e-12);
  const std::vector<EnclosedWater> waters = waters_of(scene);
  ASSERT_EQ(waters.size(), 2U);
  EXPECT_NEAR(waters[1].level, 1.5, 1e-12);
  EXPECT_NEAR(waters[0].surface, 2.75 * 2.0, 2.0 * 0.125);
  EXPECT_NEAR(waters[1].surface, 1.25 * 2.0, 2.0 * 0.125);
}

TEST(RestLevel, OfADryDockBehindItsGateIsThatOfTheSea) {
  Scene scene = channel(2.0, 1.0);
  add_block(scene, {2, -0.5, -0.5}, {2.25, 2.5, 2});
  const std::vector<EnclosedWater> waters = waters_of(scene);
  ASSERT_EQ(waters.size(), 1U);
  EXPECT_NEAR(waters[0].level, 1.0, 1e-12);
}

TEST(RestLevel, IsTheSameBehindALowSill) {
  // 6 m^3, of which the sill takes up 0.25 x 0.5 x 2 m^3 of room: 8 level - 0.25 = 6.
  Scene scene = channel(2.0, 1.5);
  add_block(scene, {2, -0.5, -0.5}, {2.25, 2.5, 0.5});
  EXPECT_NEAR(level_of(scene), 6.25 / 8.0, 1e-9);
}

TEST(RestLevel, OfATubAboveTheSeaIsItsOwn) {
  // Water on a platform with a rim all round, above the sea.
  Scene scene = channel(4.0, 0.5);
  scene.water.blocks.push_back({{2, 0, 1}, {4, 2, 1.5}});
  add_block(scene, {1.75, -0.5, 0.75}, {4.5, 2.5, 1});
  add_block(scene, {1.75, -0.5, 0.75}, {2, 2.5, 2});
  const std::vector<EnclosedWater> waters = waters_of(scene);
  ASSERT_EQ(waters.size(), 2U);
  EXPECT_NEAR(level_of(scene), 0.5, 1e-12);
  EXPECT_NEAR(waters[1].level, 1.5, 1e-12);
}

TEST(RestLevel, IsTheSameForAnyNumberOfThreads) {
  Scene scene = channel(2.0, 1.3);
  add_block(scene, {1.9, -0.5, -0.5}, {2.3, 2.5, 0.4});
  EXPECT_EQ(level_of(scene), World(scene, {5, nullptr, {}}).water_level());
}

}  // namespace
}  // namespace pelagos
