// What carries bodies beyond the open edges of a patch; test_bodies_at_sea_runs has the long runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>
#include <vector>

#include "same_run.hpp"
#include "scales/scales.hpp"
#include "sea_barge.hpp"
#include "simulation/sea_push.hpp"
#include "simulation/world.hpp"

namespace pelagos {
namespace {

using test::barge;
using test::deep_edged_patch;
using test::edged_patch;
using test::first_body;
using test::kSeaDensity;
using test::sail;
using test::with_body;

TEST(BodiesAtSea, WhatFloatsOutsideChangesNothingInside) {
  Scene scene = with_body(deep_edged_patch(), barge({6.0, 5.0, 4.0}, {0.0, 0.0, 0.0})), more = scene;
  scene.far_sea.waves = more.far_sea.waves = {{0.5, 36.0, 0.0, 60.0, 0.0}};
  more.bodies.push_back(barge({8.0, 4.0, 2.0}, {60.0, 0.0, 0.0}));
  more.bodies.back().id = 2;
  World one(scene, {1, nullptr, {}}), other(more, {1, nullptr, {}});
  EXPECT_TRUE(one.bodies().boxes_at_edges(one.patch(), one.fluid().coupling.fade).empty());
  EXPECT_EQ(other.bodies().boxes_at_edges(other.patch(), other.fluid().coupling.fade).size(), 1U);
  for (int step = 0; step < 40; ++step) {
    ASSERT_EQ(one.advance().fault, StepFault::kNone);
    ASSERT_EQ(other.advance().fault, StepFault::kNone);
    ASSERT_EQ(state_hash(one.fluid().particles), state_hash(other.fluid().particles)) << step;
    ASSERT_EQ(first_body(one).position, first_body(other).position) << step;
  }
}

TEST(BodiesAtSea, TheBridgeGetsLoadsOutsideToo) {
  Scene scene = with_body(edged_patch(), barge({8.0, 4.0, 2.0}, {60.0, 0.0, 0.0}, BodyDrive::kPose));
  World world(scene, {1, nullptr, {}});
  WorldStep step = world.advance();
  while (!step.frame_reached) step = world.advance();
  Snapshot snapshot;
  world.take_frame(snapshot, step.report);
  ASSERT_EQ(snapshot.loads.size(), 1U);
  const double weight = kSeaDensity * kStandardGravity * 32.0;
  EXPECT_NEAR(snapshot.loads[0].force.z(), weight, 1e-4 * weight);
  EXPECT_NEAR(snapshot.loads[0].buoyant_force.z(), weight, 1e-4 * weight);
  EXPECT_NEAR(snapshot.loads[0].wetted_volume, 32.0, 0.01);
}

Scene many_at_edges() {
  Scene scene = with_body(deep_edged_patch(), barge({6.0, 5.0, 4.0}, {24.0, 1.0, 0.0}));
  BodySettings raft = barge({1, 1, 1}, {-60.0, 20.0, 0.3});
  raft.id = 2;
  raft.primitive = CylinderShape{1.5, 0.8};
  scene.bodies.push_back(raft);
  BodySettings led = barge({6.0, 3.0, 3.0}, {0.0, -16.0, 0.0}, BodyDrive::kPoseHorizontal);
  led.id = 3;
  scene.bodies.push_back(led);
  scene.far_sea.waves = {{0.5, 36.0, 0.0, 60.0, 0.0}, {0.2, 21.0, 0.0, 130.0, 40.0}};
  scene.open_sea.follow_velocity = {4.0, 1.0};
  return scene;
}

TEST(BodiesAtSea, HasTheSameBitsForAnyNumberOfThreads) {
  std::vector<WorldState> states;
  for (const int threads : {1, 2, 3}) {
    World world(many_at_edges(), {threads, nullptr, {}});
    sail(world, 2.0);
    states.push_back(world.state());
  }
  EXPECT_FALSE(states[0].rim_gaps.empty()) << "a hull stands in the rim";
  for (std::size_t k = 1; k < 3; ++k) {
    const auto difference = find_difference(states[0], states[k]);
    EXPECT_FALSE(difference.has_value()) << difference->field;
  }
}

TEST(BodiesAtSea, GoesOnFromAFile) { test::expect_same_run(many_at_edges(), 40, 80); }

std::string refusal_of(const Scene& scene) {
  try {
    const World world(scene, {1, nullptr, {}});
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(BodiesAtSea, OnlyWhatMovesMayStartBeyondAnOpenEdge) {
  EXPECT_EQ(refusal_of(with_body(edged_patch(), barge({8, 4, 2}, {5000, -300, 0}))), "");
  EXPECT_EQ(refusal_of(with_body(edged_patch(), barge({8, 4, 2}, {60, 0, 0}, BodyDrive::kPose))), "");
  EXPECT_THAT(refusal_of(with_body(edged_patch(), barge({8, 4, 2}, {60, 0, 0}, BodyDrive::kStatic))),
              testing::HasSubstr("its surface lies outside the patch"));
  Scene channel = edged_patch();
  channel.patch_edges[1] = PatchEdge::kMirror;
  EXPECT_EQ(refusal_of(with_body(channel, barge({8, 4, 2}, {60, 0, 0}))), "");
  EXPECT_THAT(refusal_of(with_body(channel, barge({8, 4, 2}, {0, 60, 0}))),
              testing::HasSubstr("its surface lies outside the patch"));
}

TEST(BodiesAtSea, AddedMassIsThatOfAKnownEllipsoid) {
  const AddedMass sphere = ellipsoid_added_mass({2.0, 2.0, 2.0});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sphere.along[axis], 0.5, 1e-6);
    EXPECT_EQ(sphere.about[axis], 0.0);
  }
  const AddedMass prolate = ellipsoid_added_mass({4.0, 1.0, 1.0});  // Lamb 1932, section 115: 0.082, 0.860, k' 0.608
  EXPECT_NEAR(prolate.along.x(), 0.082, 0.0006);
  EXPECT_NEAR(prolate.along.y(), 0.860, 0.0006);
  EXPECT_NEAR(prolate.about.y(), 0.608 * (16.0 + 1.0) / 5.0, 0.003);
  const AddedMass disc = ellipsoid_added_mass({1.0, 1.0, 0.001});  // 8/3 rho R^3
  EXPECT_NEAR(disc.along.z() * 4.0 / 3.0 * std::numbers::pi * 0.001, 8.0 / 3.0, 0.01);
}

}  // namespace
}  // namespace pelagos
