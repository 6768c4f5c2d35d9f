#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/world.hpp"

namespace pelagos {
namespace {

using testing::Each;
using testing::ElementsAre;

/// Water 3 m deep between mirrors, 24 x 16 m, d = 1 m, with one body that never moves.
Scene still_water(const Primitive& primitive, const Eigen::Vector3d& position) {
  Scene scene;
  scene.name = "still";
  scene.particle_spacing = 1.0;
  scene.patch = {{-12.0, -8.0, 0.0}, {12.0, 8.0, 8.0}};
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{scene.patch.min, {12.0, 8.0, 3.0}}};
  BodySettings body;
  body.id = 1;
  body.name = "scenery";
  body.primitive = primitive;
  body.position = position;
  body.drive = BodyDrive::kStatic;
  scene.bodies = {body};
  return scene;
}

/// A bed whose top goes through (0, 0, height) and rises towards +x.
Scene sloping_bed(double angle, double height) {
  constexpr double kThick = 20.0;
  Scene scene = still_water(BoxShape{{100.0, 60.0, kThick}},
                            {0.5 * kThick * std::sin(angle), 0.0, height - 0.5 * kThick * std::cos(angle)});
  scene.bodies[0].orientation = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY());
  return scene;
}

const FluidState& start_of(const Scene& scene, std::optional<World>& world) {
  return world.emplace(scene, WorldOptions{1, nullptr, {}}).fluid();
}

TEST(SlantedFaces, FacesThatASolidMeetsSquarelyStayMirrors) {
  std::optional<World> world;
  for (const Scene& scene : {still_water(BoxShape{{4.0, 4.0, 6.0}}, {0.0, 0.0, 2.0}),    // stands on the floor
                             still_water(BoxShape{{4.0, 4.0, 6.0}}, {11.0, 7.0, 2.0}),   // in a corner
                             still_water(BoxShape{{4.0, 40.0, 20.0}}, {0.0, 0.0, 0.0}),  // from side to side
                             still_water(CylinderShape{2.0, 20.0}, {3.3, -2.1, 0.0}),    // a pile
                             still_water(SphereShape{2.0}, {0.0, 0.0, 5.0})}) {          // above the water
    const FluidState& fluid = start_of(scene, world);
    EXPECT_THAT(fluid.parameters.edges, Each(Edge::kMirror));
    EXPECT_EQ(fluid.face_count, 0U);
  }
}

TEST(SlantedFaces, TheFaceAtTheFootOfAMoundIsASurface) {
  std::optional<World> world;
  const FluidState& fluid = start_of(still_water(SphereShape{10.0}, {0.0, 0.0, -8.5}), world);
  EXPECT_THAT(fluid.parameters.edges, ElementsAre(Edge::kMirror, Edge::kMirror, Edge::kOpen));
  ASSERT_EQ(fluid.face_count, 2U);
  ASSERT_EQ(fluid.solids.size(), 3U);
  const auto floor = surface_at(fluid.solids[0], {7.3F, -2.2F, 0.4F}, 2.0F);
  ASSERT_TRUE(floor);
  EXPECT_FLOAT_EQ(floor->z, 1.0F);
  EXPECT_NEAR(floor->w, 0.4F, 1e-5F);
  const auto ceiling = surface_at(fluid.solids[1], {7.3F, -2.2F, 8.1F}, 2.0F);
  ASSERT_TRUE(ceiling);
  EXPECT_FLOAT_EQ(ceiling->z, -1.0F);
  EXPECT_NEAR(ceiling->w, -0.1F, 1e-5F);
}

TEST(SlantedFaces, ABedThatRisesTowardsASideTakesThatSide) {
  std::optional<World> world;
  EXPECT_THAT(start_of(sloping_bed(0.15, 0.0), world).parameters.edges,
              ElementsAre(Edge::kOpen, Edge::kMirror, testing::_));
  EXPECT_THAT(start_of(sloping_bed(0.02, 0.0), world).parameters.edges[0], Edge::kMirror) << "square but for 1 degree";
}

TEST(SlantedFaces, AStepMakesTheSolidsAnewAndKeepsTheFaces) {
  World world(still_water(SphereShape{10.0}, {0.0, 0.0, -8.5}), {1, nullptr, {}});
  for (int step = 0; step < 3; ++step) ASSERT_EQ(world.advance({}).fault, StepFault::kNone);
  EXPECT_EQ(world.fluid().face_count, 2U);
  EXPECT_EQ(world.fluid().solids.size(), 3U);
}

TEST(StartingWater, FillsTheVolumeOverASlope) {
  std::optional<World> world;
  const FluidState& fluid = start_of(sloping_bed(0.2, 0.0), world);
  // Under the level of 3 m: over the floor where the bed lies deeper, and over the bed.
  double volume = 0.0;
  constexpr double kLength = 24.0, kWidth = 16.0;
  constexpr int kSlices = 2400;
  for (int k = 0; k < kSlices; ++k) {
    const double x = -0.5 * kLength + kLength * (k + 0.5) / kSlices;
    volume += kWidth * kLength / kSlices * std::max(0.0, 3.0 - std::max(0.0, x * std::tan(0.2)));
  }
  EXPECT_NEAR(static_cast<double>(fluid.particles.count) / volume, 1.0, 0.02);
}

}  // namespace
}  // namespace pelagos
