#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "floating.hpp"
#include "simulation/world.hpp"
#include "world_access.hpp"

namespace pelagos {
namespace {

using test::body_of;
using test::expect_sound;
using test::floating_box;
using test::kAllSolvers;
using test::run_until;

Eigen::Vector3d water_momentum(const World& world) {
  const FluidParticles& p = world.fluid().particles;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < p.count; ++i) sum += Eigen::Vector3d(p.velocity[i].x, p.velocity[i].y, p.velocity[i].z);
  return world.fluid().parameters.rest_density * world.fluid().parameters.volume() * sum;
}

TEST(FreeBodies, TakeWhatTheWaterGives) {
  // No weight, no walls near: a body thrown through a ball of water. What it loses the water has.
  for (const SolverKind solver : kAllSolvers) {
    Scene scene = floating_box(0.5, solver);
    scene.gravity = 0.0;
    scene.patch = {{-3, -3, -3}, {3, 3, 3}};
    scene.water.blocks = {{{-1, -1, -1}, {1, 1, 1}}};
    scene.water.settle_steps = 0;
    scene.water.kinematic_viscosity = 0.0;
    scene.time_step.max_step = 0.005;
    scene.bodies[0].position = {-1.5, 0.2, 0.1};
    scene.bodies[0].velocity = {2.0, 0.0, 0.0};
    World world(scene, {2, nullptr, {}});
    const double mass = 0.5 * 1000.0 * 1.152;
    const Eigen::Vector3d before = water_momentum(world) + mass * scene.bodies[0].velocity;
    double passed = 0.0, largest_gap = 0.0;
    for (int step = 0; step < 100; ++step) {
      expect_sound(world.advance());
      const Eigen::Vector3d now = water_momentum(world) + mass * body_of(world).velocity;
      largest_gap = std::max(largest_gap, (now - before).norm());
      passed += world.fluid().coupling.bodies[0].impulse.norm();
    }
    EXPECT_GT(passed, 50.0) << "the body must have met the water, solver " << static_cast<int>(solver);
    EXPECT_LT(largest_gap, 1e-3 * passed) << "solver " << static_cast<int>(solver);
  }
}

TEST(FreeBodies, MoveOnlyAsTheyMay) {
  Scene scene = floating_box(0.5);
  scene.water.settle_steps = 10;
  BodySettings& box = scene.bodies[0];
  box.orientation = Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.6, 0.8, 0.0));
  box.position.z() += 0.1;
  box.velocity = {0.3, 0.0, 0.0};
  box.freedoms = {{0.0, 0.0, 1.0}, Eigen::Vector3d::Zero()};
  World world(scene, {2, nullptr, {}});
  const BodyState before = body_of(world);
  double lowest = before.position.z();
  run_until(world, 0.6, [&](const WorldStep& step) {
    expect_sound(step);
    lowest = std::min(lowest, body_of(world).position.z());
  });
  EXPECT_LT(lowest, before.position.z() - 0.05) << "it heaves";
  EXPECT_NEAR(body_of(world).position.x() - before.position.x(), 0.3 * world.time(), 1e-6) << "it is towed";
  EXPECT_EQ(body_of(world).position.y(), before.position.y());
  EXPECT_LT(body_of(world).orientation.angularDistance(before.orientation), 1e-12);
}

TEST(FreeBodies, ComeBackWithTheWaterAfterAFault) {
  Scene scene = floating_box(0.5);
  scene.on_fault = FaultPolicy::kRestore;
  World world(scene, {2, nullptr, {}});
  run_until(world, 0.2, expect_sound);
  const BodyState before = body_of(world);
  const std::uint64_t hash = state_hash(world.fluid().particles);
  WorldTestAccess::fluid(world).particles.velocity[100].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(world.advance().fault, StepFault::kRestored);
  EXPECT_EQ(state_hash(world.fluid().particles), hash);
  EXPECT_EQ(body_of(world).position, before.position);
  EXPECT_EQ(body_of(world).orientation.coeffs(), before.orientation.coeffs());
  EXPECT_EQ(body_of(world).velocity, before.velocity);
  run_until(world, 0.4, expect_sound);
}

}  // namespace
}  // namespace pelagos
