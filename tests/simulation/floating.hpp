#pragma once

#include <gtest/gtest.h>

#include "simulation/world.hpp"
#include "values/scene.hpp"

namespace pelagos::test {

inline constexpr SolverKind kAllSolvers[] = {SolverKind::kHybrid, SolverKind::kDfsph, SolverKind::kPbf,
                                             SolverKind::kCorrected};

/// A box of 1.2 x 1.2 x 0.8 m, so flat that it floats upright, in a patch of 3.2 x 3.2 m with 1.2 m of water, d = 0.1
/// m.
inline Scene floating_box(double density_ratio, SolverKind solver = SolverKind::kCorrected) {
  Scene scene;
  scene.name = "floating";
  scene.particle_spacing = 0.1;
  scene.patch = {{0, 0, 0}, {3.2, 3.2, 2.4}};
  scene.water.blocks = {{{0, 0, 0}, {3.2, 3.2, 1.2}}};
  scene.water.settle_steps = 100;
  scene.solver = default_solver(solver);
  BodySettings body;
  body.id = 1;
  body.name = "box";
  body.primitive = BoxShape{{1.2, 1.2, 0.8}};
  body.drive = BodyDrive::kFree;
  body.mass.density = density_ratio * scene.water.rest_density;
  body.position = {1.6, 1.6, 1.15 + 0.8 * (0.5 - density_ratio)};
  scene.bodies = {body};
  return scene;
}

/// A sphere of 5 spacings' radius under water: 2 m deep and wide, d = 0.1 m.
inline Scene sunken_sphere(double density_ratio, SolverKind solver = SolverKind::kCorrected) {
  Scene scene = floating_box(density_ratio, solver);
  scene.patch = {{0, 0, 0}, {3, 3, 3}};
  scene.water.blocks = {{{0, 0, 0}, {3, 3, 2.4}}};
  scene.bodies[0].primitive = SphereShape{0.5};
  scene.bodies[0].position = {1.5, 1.5, 1.2};
  return scene;
}

inline BodyState body_of(const World& world, std::size_t index = 0) { return world.bodies().states()[index]; }

/// Fails the test where a step went wrong.
inline void expect_sound(const WorldStep& step) {
  ASSERT_EQ(step.report.not_finite, 0U);
  ASSERT_EQ(step.fault, StepFault::kNone);
  ASSERT_LT(step.report.outside, 10U);
}

/// Advances to `time` (s); calls visit(step) after each step.
template <class Visit>
void run_until(World& world, double time, Visit&& visit) {
  while (world.time() < time) visit(world.advance());
}

}  // namespace pelagos::test
