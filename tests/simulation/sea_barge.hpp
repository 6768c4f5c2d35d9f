#pragma once

#include <gtest/gtest.h>

#include "simulation/world.hpp"
#include "values/scene.hpp"

namespace pelagos::test {

inline constexpr double kSeaDensity = 1000.0;

/// 28 x 24 x 4 m of an open sea, d = 1 m.
inline Scene edged_patch() {
  Scene scene;
  scene.name = "edged_patch";
  scene.particle_spacing = 1.0;
  scene.patch = {{-14, -12, -4}, {14, 12, 8}};
  scene.patch_edges = {PatchEdge::kOpen, PatchEdge::kOpen, PatchEdge::kWall};
  scene.water.blocks = {{{-14, -12, -4}, {14, 12, 0}}};
  scene.open_sea.zone_width = 4.0;
  return scene;
}

/// 36 x 30 x 8 m of an open sea: water under a barge of a draft of 3 m.
inline Scene deep_edged_patch() {
  Scene scene = edged_patch();
  scene.patch = {{-18, -15, -8}, {18, 15, 8}};
  scene.water.blocks = {{{-18, -15, -8}, {18, 15, 0}}};
  return scene;
}

/// A box barge of half the water's density that floats upright at z = 0.
inline BodySettings barge(const Eigen::Vector3d& size, const Eigen::Vector3d& position,
                          BodyDrive drive = BodyDrive::kFree) {
  BodySettings body;
  body.id = 1;
  body.name = "barge";
  body.primitive = BoxShape{size};
  body.drive = drive;
  if (drive != BodyDrive::kPose) body.mass.density = 0.5 * kSeaDensity;
  body.position = position;
  return body;
}

inline Scene with_body(Scene scene, const BodySettings& body) {
  scene.bodies.push_back(body);
  return scene;
}

inline BodyState first_body(const World& world) { return world.bodies().states()[0]; }

template <class Visit>
inline void sail(World& world, double until, Visit&& visit) {
  while (world.time() < until) {
    ASSERT_EQ(world.advance().fault, StepFault::kNone) << world.time();
    visit();
  }
}
inline void sail(World& world, double until) {
  sail(world, until, [] {});
}

}  // namespace pelagos::test
