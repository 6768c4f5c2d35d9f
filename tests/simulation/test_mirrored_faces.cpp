#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/world.hpp"

namespace pelagos {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kSpacing = 0.1;

/// A channel of 2 x 0.8 m, its left half 0.8 m deep, a gate across its middle.
/// @param thickness  m, of the gate
/// @param past       m, that it reaches past both sides and the floor; negative: it ends before
Scene gated(double thickness, double past, BodyDrive drive = BodyDrive::kStatic) {
  Scene scene;
  scene.name = "gated";
  scene.particle_spacing = kSpacing;
  scene.patch = {{-1, 0, 0}, {1, 0.8, 1.4}};
  scene.patch_edges = {PatchEdge::kWall, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{{-1, 0, 0}, {-0.5 * thickness, 0.8, 0.8}}};
  scene.water.settle_steps = 0;
  BodySettings gate;
  gate.id = 1;
  gate.name = "gate";
  gate.primitive = BoxShape{{thickness, 0.8 + 2.0 * past, 1.2 + past}};
  gate.position = {0.0, 0.4, 0.5 * (1.2 - past)};
  gate.drive = drive;
  scene.bodies = {gate};
  return scene;
}

std::vector<std::string> notes_of(const Scene& scene) { return World(scene, {1, nullptr, {}}).start_notes(); }

auto tells_of(const std::string& face) { return AllOf(HasSubstr("body 1 (gate)"), HasSubstr("mirrored face " + face)); }

TEST(MirroredFaces, AGapUnderASupportRadiusIsTold) {
  EXPECT_THAT(notes_of(gated(0.2, -0.05)), ElementsAre(AllOf(tells_of("y = 0 m"), HasSubstr("ends 0.05 m before"),
                                                             HasSubstr("let it reach the face")),
                                                       tells_of("y = 0.8 m"), tells_of("z = 0 m")));
  EXPECT_EQ(notes_of(gated(0.2, -0.18)).size(), 3U);
  EXPECT_THAT(notes_of(gated(0.2, -0.21)), IsEmpty()) << "water passes, as meant";
}

TEST(MirroredFaces, AGateThatGoesUpToThemIsFine) {
  for (const double spacings : {0.1, 0.2, 1.0, 2.0, 4.0})
    for (const double past : {0.0, 0.1, 0.5, 1.0, 3.0})
      EXPECT_THAT(notes_of(gated(spacings * kSpacing, past * kSpacing)), IsEmpty()) << spacings << ' ' << past;
}

TEST(MirroredFaces, WhatStaysAboveTheWaterIsFine) {
  Scene scene = gated(0.2, 0.0);
  scene.bodies[0].primitive = BoxShape{{0.2, 0.8, 0.2}};
  scene.bodies[0].position.z() = 1.1;
  EXPECT_THAT(notes_of(scene), IsEmpty());
}

TEST(MirroredFaces, TheTopOfThePatchAboveTheWaterIsNoFace) {
  Scene scene = gated(0.2, 0.1);
  scene.water.blocks = {{{-1, 0, 0}, {1, 0.8, 0.8}}};
  scene.patch.max.z() = 1.0;
  EXPECT_THAT(notes_of(scene), IsEmpty()) << "two spacings above it, the gate goes on past it";
  scene.patch.max.z() = 1.3;
  EXPECT_THAT(notes_of(scene), IsEmpty()) << "the gate ends before it";
}

TEST(MirroredFaces, AFreeBodyIsToldToKeepAwayOnly) {
  Scene scene = gated(0.4, 0.0);
  BodySettings& body = scene.bodies[0];
  body.primitive = BoxShape{{0.2, 0.2, 0.2}};
  body.position = {-0.5, 0.15, 0.4};
  body.drive = BodyDrive::kFree;
  body.mass.density = 500.0;
  EXPECT_THAT(notes_of(scene), ElementsAre(AllOf(HasSubstr("ends 0.05 m before the mirrored face y = 0 m"),
                                                 HasSubstr("keep it 0.2 m away"), testing::Not(HasSubstr("let it")))));
}

TEST(MirroredFaces, PartsOfAWallMayHoldEachOther) {
  // The gate ends at the face, a pier that it runs into does not.
  Scene scene = gated(0.2, 0.1);
  BodySettings pier = scene.bodies[0];
  pier.id = 2;
  pier.name = "pier";
  pier.primitive = BoxShape{{0.4, 0.3, 1.6}};
  for (const double y : {0.0, 0.8}) {
    pier.id += 1;
    pier.position = {0.0, y, 0.6};
    scene.bodies.push_back(pier);
  }
  scene.bodies[0].primitive = BoxShape{{0.2, 0.7, 1.4}};
  EXPECT_THAT(notes_of(scene), IsEmpty());
}

TEST(MirroredFaces, ASlopeThatGoesOnIsFine) {
  Scene scene = gated(0.2, 0.3);
  scene.bodies[0].orientation = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX());
  scene.bodies[0].primitive = BoxShape{{0.2, 3.0, 3.0}};
  EXPECT_THAT(notes_of(scene), IsEmpty());
}

/// Particles behind the gate after two seconds.
std::ptrdiff_t leaked(const Scene& scene) {
  World world(scene, {1, nullptr, {}});
  while (world.time() < 2.0) world.advance();
  const FluidParticles& p = world.fluid().particles;
  const auto behind = static_cast<float>(0.5 * std::get<BoxShape>(*scene.bodies[0].primitive).size.x());
  return std::count_if(p.position.begin(), p.position.begin() + static_cast<std::ptrdiff_t>(p.count),
                       [behind](const Float4& x) { return x.x > behind; });
}

TEST(MirroredFaces, AGateOfAnyThicknessHoldsTheWater) {
  for (const double spacings : {0.1, 0.2, 1.0, 2.0, 4.0})
    for (const double past : {0.0, 0.3, 1.0})
      for (const BodyDrive drive : {BodyDrive::kStatic, BodyDrive::kPose}) {
        if (drive == BodyDrive::kPose && past > 0.0) continue;
        EXPECT_EQ(leaked(gated(spacings * kSpacing, past * kSpacing, drive)), 0)
            << spacings << " spacings thick, " << past << " past, drive " << static_cast<int>(drive);
      }
}

TEST(MirroredFaces, SamplesOfAPlateLeaveGapsAtTheFace) {
  // A plate has samples in place of a distance field. Between the last of them and their images there may be a gap of
  // two spacings, through which single ones of the 576 particles pass.
  EXPECT_LE(leaked(gated(0.5 * kSpacing, 0.0)), 15);
}

TEST(MirroredFaces, WallsHoldItAsWell) {
  Scene scene = gated(0.1, 0.0);
  scene.patch_edges = kWallsAround;
  EXPECT_EQ(leaked(scene), 0);
}

}  // namespace
}  // namespace pelagos
