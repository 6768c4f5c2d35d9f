#include "fields/field_hash.hpp"
#include "give.hpp"
#include "simulation/world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_patch.hpp"

namespace pelagos {
namespace {

using test::CubeFile;
using test::patch_with_cube;
using test::small_patch;

WindSettings breeze() {
  WindSettings wind;
  wind.velocity = {8, 3, 0};
  wind.amplitude = 2;
  wind.length = 4;
  return wind;
}

BodyPose pose_at(double time, double x, double speed) {
  BodyPose pose;
  pose.body = 1;
  pose.time = time;
  pose.position = {x, 2.0, 0.9};
  pose.velocity = {speed, 0, 0};
  return pose;
}

TEST(World, RestsAtTheLevelItStates) {
  const World world(small_patch(), {1, nullptr, {}});
  // Five layers, the lowest half a spacing above the floor: the level stands half a spacing above the highest.
  EXPECT_NEAR(world.water_level(), 5 * 0.25, 1e-12);
  EXPECT_EQ(world.fluid().particles.count, 1600U);
  // Over a sampled floor there are four, the lowest a spacing above it.
  Scene sampled = small_patch();
  sampled.solver.kind = SolverKind::kHybrid;
  const World over_samples(sampled, {1, nullptr, {}});
  EXPECT_NEAR(over_samples.water_level(), 4.5 * 0.25, 1e-12);
  EXPECT_EQ(over_samples.fluid().particles.count, 1140U);
}

/// A sea that is paused before its first step is shown too.
TEST(World, IsSeenBeforeItsFirstStep) {
  const CubeFile cube;
  Scene scene = patch_with_cube(cube);
  for (const BodyDrive drive : {BodyDrive::kPose, BodyDrive::kFree})
    for (const int settle_steps : {0, 1}) {
      scene.bodies[0].drive = drive;
      scene.bodies[0].mass.density = 500.0;
      scene.water.settle_steps = settle_steps;
      World world(scene, {1, nullptr, {}});
      Snapshot snapshot;
      StepReport report;
      world.take_frame(snapshot, report);
      EXPECT_GT(snapshot.particles.size(), 200U) << "its surface";  // a column in four at least: 19 x 15 columns
      ASSERT_EQ(snapshot.bodies.size(), 1U);
      EXPECT_TRUE(snapshot.bodies[0].position.allFinite());
    }
}

TEST(World, SameBitsForOneTwoAndSevenThreads) {
  const CubeFile cube;
  Scene scene = patch_with_cube(cube);
  scene.wind = breeze();
  World one(scene, {1, nullptr, {}}), two(scene, {2, nullptr, {}}), seven(scene, {7, nullptr, {}});
  Snapshot a, b;
  for (int step = 0; step < 60; ++step) {
    for (World* world : {&one, &two, &seven}) {
      if (step % 2 == 0) test::give(*world, pose_at(0.02 * step, 2.5 + 0.01 * step, 0.5));
      if (step == 30) {
        WindSettings stronger = breeze();
        stronger.velocity *= 2.0;
        static_cast<void>(test::give(*world, SetWind{stronger, 0.2}));
      }
    }
    WorldStep s = one.advance(), t = two.advance();
    seven.advance();
    ASSERT_EQ(state_hash(one.fluid().particles), state_hash(two.fluid().particles)) << "first differing step " << step;
    ASSERT_EQ(state_hash(one.fluid().particles), state_hash(seven.fluid().particles))
        << "first differing step " << step;
    if (!s.frame_reached) continue;
    one.take_frame(a, s.report);
    two.take_frame(b, t.report);
    ASSERT_EQ(a.particles.size(), b.particles.size());
    for (std::size_t i = 0; i < a.particles.size(); ++i) {
      ASSERT_EQ(a.particles[i].position, b.particles[i].position);
      ASSERT_EQ(a.particles[i].semi_axes, b.particles[i].semi_axes);
    }
  }
}

TEST(World, FramesComeAtExactMultiples) {
  Scene scene = small_patch();
  scene.frame_interval = 0.04;
  World world(scene, {2, nullptr, {}});
  std::uint64_t frames = 0;
  while (frames < 10) {
    if (!world.advance().frame_reached) continue;
    ++frames;
    EXPECT_EQ(world.time(), 0.04 * static_cast<double>(frames));
  }
}

TEST(World, WaterMakesRoomForAHullAndStaysOutOfIt) {
  const CubeFile cube;
  World world(patch_with_cube(cube), {2, nullptr, {}});
  EXPECT_LT(world.fluid().particles.count, 1600U);
  const std::size_t count = world.fluid().particles.count;
  for (int step = 0; step < 120; ++step) {
    test::give(world, pose_at(0.01 * step, 2.5, 0.0));
    const WorldStep made = world.advance();
    ASSERT_EQ(made.report.not_finite, 0U);
    ASSERT_EQ(made.report.outside, 0U);
  }
  EXPECT_EQ(world.fluid().particles.count, count);
  for (std::size_t i = 0; i < count; ++i) {
    const Float4& p = world.fluid().particles.position[i];
    const Eigen::Vector3d x = Eigen::Vector3d(p.x, p.y, p.z) + world.patch().origin - Eigen::Vector3d(2.5, 2.0, 0.9);
    // The samples stop water 0.6 spacings inside the surface less the usual distance of one spacing.
    EXPECT_GT(x.cwiseAbs().maxCoeff(), 0.5 - 0.25) << "a particle deep inside the hull";
  }
}

TEST(World, AJumpingBodyLosesNoWaterAndTrapsNone) {
  const CubeFile cube;
  World world(patch_with_cube(cube), {2, nullptr, {}});
  const std::size_t count = world.fluid().particles.count;
  test::give(world, pose_at(0.0, 1.0, 0.0));
  for (int step = 0; step < 40; ++step) world.advance();
  test::give(world, pose_at(10.0, 4.0, 0.0));
  double fastest = 0.0;
  for (int step = 0; step < 80; ++step) {
    const WorldStep made = world.advance();
    fastest = std::max(fastest, made.report.largest_speed);
    ASSERT_EQ(made.report.not_finite, 0U);
    ASSERT_EQ(made.report.outside, 0U);
  }
  EXPECT_EQ(world.fluid().particles.count, count);
  // No explosion: nothing flies faster than a fall through the patch's height of 3 m.
  EXPECT_LT(fastest, std::sqrt(2.0 * 9.81 * 3.0));
}

TEST(World, NoWindCostsNothingAndWindCarriesTheWater) {
  World calm(small_patch(), {1,
                             [] {
                               static std::int64_t tick = 0;
                               return ++tick;
                             },
                             {}});
  EXPECT_EQ(calm.advance().report.times.ns[static_cast<std::size_t>(Stage::kWind)], 0);
  EXPECT_FALSE(calm.wind().has_value());

  Scene scene = small_patch();
  scene.wind = breeze();
  World windy(scene, {1, nullptr, {}});
  double drift = 0.0;
  for (int step = 0; step < 40; ++step) windy.advance();
  for (std::size_t i = 0; i < windy.fluid().particles.count; ++i)
    drift += static_cast<double>(windy.fluid().particles.velocity[i].x);
  EXPECT_GT(drift / static_cast<double>(windy.fluid().particles.count), 0.0);
}

/// Kinetic energy of the mean flow that a steady wind has raised in a channel without ends after 2 s, J, with steps of
/// at most `step`. What single particles move besides is the method's noise and no gain.
double energy_gained(WindLaw law, double step) {
  Scene scene = small_patch();
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kPeriodic, PatchEdge::kMirror};
  scene.water.settle_steps = 0;
  scene.time_step.max_step = step;
  scene.wind = breeze();
  scene.wind->law = law;
  scene.wind->amplitude = 0.0;
  scene.wind->velocity = {law == WindLaw::kStress ? 40.0 : 12.0, 0.0, 0.0};
  World world(scene, {1, nullptr, {}});
  while (world.time() < 2.0 - 1e-9) world.advance();
  const FluidParticles& p = world.fluid().particles;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) sum += static_cast<double>(p.velocity[i].x);
  const double mass = 1000.0 * world.fluid().parameters.volume();
  return 0.5 * mass * sum * sum / static_cast<double>(p.count);
}

TEST(World, HalfTheStepTakesTheSameEnergyFromTheWind) {
  for (const WindLaw law : {WindLaw::kGust, WindLaw::kStress}) {
    const double whole = energy_gained(law, 0.008), half = energy_gained(law, 0.004);
    EXPECT_GT(whole, 0.1) << "J; else there is nothing to compare";
    EXPECT_LT(std::abs(half / whole - 1.0), 0.05) << static_cast<int>(law) << ": " << whole << " and " << half;
  }
}

TEST(World, ThePapersWindGivesMoreToShorterSteps) {
  // A velocity is added every step: twice the steps, twice the velocity, four times the energy.
  const double whole = energy_gained(WindLaw::kPaper, 0.008), half = energy_gained(WindLaw::kPaper, 0.004);
  EXPECT_GT(half / whole, 3.0);
}

TEST(World, TellsTheAirThatPushesItsWater) {
  Scene scene = small_patch();
  World world(scene, {1, nullptr, {}});
  EXPECT_FALSE(world.air());
  WindSettings wind = breeze();
  static_cast<void>(test::give(world, SetWind{wind, 0.0}));
  ASSERT_TRUE(world.air());
  const Eigen::Vector3d mast(1.0, 2.0, world.water_level() + 10.0);
  wind.amplitude = 0.0;
  static_cast<void>(test::give(world, SetWind{wind, 0.0}));
  EXPECT_LT((world.air()->velocity_at(mast, world.time()) - wind.velocity).norm(), 1e-12);
}

TEST(World, RefusesABodyWithoutAMesh) {
  Scene scene = small_patch();
  BodySettings body;
  body.id = 4;
  body.name = "ghost";
  body.mesh_file = "/nowhere/ghost.obj";
  scene.bodies = {body};
  try {
    const World world(scene, {1, nullptr, {}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("ghost"), std::string::npos) << error.what();
  }
}

TEST(World, AcceptsPosesOfItsBodiesOnly) {
  const CubeFile cube;
  World world(patch_with_cube(cube), {1, nullptr, {}});
  const auto hash = [&world] { return hash_fields(world.state().bodies); };
  const std::uint64_t still = hash();
  test::give(world, pose_at(0.0, 2.5, 0.0));
  const std::uint64_t led = hash();
  EXPECT_NE(led, still);
  BodyPose stranger = pose_at(0.1, 2.5, 0.0);
  stranger.body = 9;
  test::give(world, stranger);
  EXPECT_EQ(hash(), led);
  test::give(world, pose_at(0.0, 2.7, 0.0));
  EXPECT_EQ(hash(), led) << "not newer than the last one";
}

}  // namespace
}  // namespace pelagos
