// The current: as a value, and as water that moves with it.

#include <gtest/gtest.h>

#include <cmath>

#include "give.hpp"
#include "simulation/world.hpp"
#include "small_patch.hpp"

namespace pelagos {
namespace {

constexpr double kRounding = 1e-12;  // sines and cosines of degrees

CurrentSettings easterly(double speed) {
  CurrentSettings current;
  current.velocity = current_velocity(speed, 90.0);
  return current;
}

TEST(CurrentValue, SetsTowardsItsDirection) {
  EXPECT_TRUE(current_velocity(2.0, 0.0).isApprox(Eigen::Vector3d(0, 2, 0), kRounding));
  EXPECT_TRUE(current_velocity(2.0, 90.0).isApprox(Eigen::Vector3d(2, 0, 0), kRounding));
  EXPECT_TRUE(current_velocity(2.0, 180.0).isApprox(Eigen::Vector3d(0, -2, 0), kRounding));
  for (const double degrees : {0.0, 37.0, 90.0, 200.0, 359.0})
    EXPECT_NEAR(current_to_deg(current_velocity(1.3, degrees)), degrees, 1e-9);
}

TEST(CurrentValue, FallsWithDepthAsItsShearSays) {
  CurrentSettings current = easterly(1.0);
  EXPECT_EQ(current.profile(1e4), 1.0);
  current.shear = CurrentShear::kLinear;
  current.depth = 20.0;
  EXPECT_EQ(current.profile(-3.0), 1.0);  // on a crest
  EXPECT_DOUBLE_EQ(current.profile(5.0), 0.75);
  EXPECT_EQ(current.profile(20.0), 0.0);
  EXPECT_EQ(current.profile(30.0), 0.0);
  current.shear = CurrentShear::kSeventhPower;
  // A seventh of the logarithm: half way down 0.5^(1/7) = 0.905724, six digits, from an independent evaluation.
  EXPECT_NEAR(current.profile(10.0), 0.905724, 1e-6);
  EXPECT_EQ(current.profile(20.0), 0.0);
}

TEST(CurrentValue, RampsFromWhatItIs) {
  Current current(0.0, {true, false});
  current.set(easterly(2.0), 10.0, 4.0);
  EXPECT_DOUBLE_EQ(current.velocity_at({0, 0, -1}, 10.0).x(), 0.0);
  EXPECT_DOUBLE_EQ(current.velocity_at({0, 0, -1}, 12.0).x(), 1.0);
  EXPECT_DOUBLE_EQ(current.surface_rate_at(12.0).x(), 0.5);
  current.set(easterly(0.0), 12.0, 1.0);  // in the middle of the ramp
  EXPECT_DOUBLE_EQ(current.velocity_at({0, 0, -1}, 12.5).x(), 0.5);
  EXPECT_DOUBLE_EQ(current.velocity_at({0, 0, -1}, 99.0).x(), 0.0);
  EXPECT_DOUBLE_EQ(current.surface_rate_at(99.0).x(), 0.0);
}

TEST(CurrentValue, TellsWhatTheWaterDoesNotDoItself) {
  Current current(0.0, {true, false});
  CurrentSettings settings;
  settings.velocity = {1.0, 2.0, 0.0};
  current.set(settings, 0.0, 0.0);
  EXPECT_EQ(current.velocity_at({0, 0, 0}, 1.0), Eigen::Vector3d(1.0, 2.0, 0.0));
  EXPECT_EQ(current.unresolved_velocity_at({0, 0, 0}, 1.0), Eigen::Vector3d(0.0, 2.0, 0.0));
}

/// 8 x 2 x 2 m of water, d = 0.25 m, periodic along x and y over a smooth floor: 32 x 8 x 8 particles.
Scene channel() {
  Scene scene;
  scene.name = "channel";
  scene.particle_spacing = 0.25;
  scene.patch = {{0, 0, 0}, {8, 2, 4}};
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kPeriodic, PatchEdge::kMirror};
  scene.water.blocks = {{{0, 0, 0}, {8, 2, 2}}};
  return scene;
}

/// Mean velocity along x of the particles between two heights, m above the floor.
double mean_speed(const World& world, double from = 0.0, double to = 100.0) {
  double sum = 0.0, count = 0.0;
  const FluidParticles& p = world.fluid().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const auto z = static_cast<double>(p.position[i].z);
    if (z < from || z >= to) continue;
    sum += static_cast<double>(p.velocity[i].x);
    count += 1.0;
  }
  return sum / count;
}

void advance_to(World& world, double time) {
  while (world.time() < time - 1e-9) {
    const WorldStep step = world.advance();
    ASSERT_EQ(step.report.not_finite, 0U);
  }
}

TEST(CurrentInAChannel, TheWaterStartsWithItAndKeepsIt) {
  Scene scene = channel();
  scene.current = easterly(1.5);
  World world(scene, {2, nullptr, {}});
  EXPECT_NEAR(mean_speed(world), 1.5, 1e-6);  // single precision
  advance_to(world, 5.0);
  EXPECT_NEAR(mean_speed(world), 1.5, 0.01 * 1.5);
}

TEST(CurrentInAChannel, WaterAtRestFollowsWithinOnePercent) {
  World world(channel(), {2, nullptr, {}});
  CurrentSettings current = easterly(1.0);
  current.relaxation = 1.0;
  static_cast<void>(test::give(world, SetCurrent{current, 0.0}));
  advance_to(world, 1.0);
  // du/dt = (U - u) / T: 1 - 1/e after T.
  EXPECT_NEAR(mean_speed(world), 1.0 - std::exp(-1.0), 0.02);
  advance_to(world, 6.0);  // e^-6 = 0.25 % is left
  EXPECT_NEAR(mean_speed(world), 1.0, 0.01);
  advance_to(world, 10.0);
  EXPECT_NEAR(mean_speed(world), 1.0, 0.01);
}

TEST(CurrentInAChannel, FollowsARampWithoutLag) {
  World world(channel(), {2, nullptr, {}});
  static_cast<void>(test::give(world, SetCurrent{easterly(1.0), 4.0}));  // with the default relaxation of 5 s
  advance_to(world, 2.0);
  EXPECT_NEAR(mean_speed(world), 0.5, 0.01);
  advance_to(world, 4.5);
  EXPECT_NEAR(mean_speed(world), 1.0, 0.01);
}

TEST(CurrentInAChannel, DoesNotDependOnTheTimeStep) {
  double speeds[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    Scene scene = channel();
    const double longest = 0.07 * std::sqrt(scene.particle_spacing / scene.gravity);
    scene.time_step.max_step = i == 0 ? longest : 0.25 * longest;
    World world(scene, {2, nullptr, {}});
    CurrentSettings current = easterly(1.0);
    current.relaxation = 2.0;
    static_cast<void>(test::give(world, SetCurrent{current, 0.0}));
    advance_to(world, 1.0);
    speeds[i] = mean_speed(world);
  }
  // Explicit Euler's error of 1 - exp(-t / T) is dt / (2 T) of it: 0.3 % here at the larger step.
  EXPECT_NEAR(speeds[0] / speeds[1], 1.0, 0.005);
}

class ShearedCurrent : public testing::TestWithParam<CurrentShear> {
 protected:
  /// Largest difference of a layer's mean from the current's, of 1 m/s at the surface, after 10 s.
  static double refusal(CurrentShear shear, double relaxation);
};

double ShearedCurrent::refusal(CurrentShear shear, double relaxation) {
  Scene scene = channel();
  scene.current = easterly(1.0);
  scene.current->shear = shear;
  scene.current->depth = 2.0;
  scene.current->relaxation = relaxation;
  World world(scene, {2, nullptr, {}});
  advance_to(world, 10.0);
  double largest = 0.0;
  for (int layer = 0; layer < 4; ++layer) {
    const double below = 0.5 * layer, above = below + 0.5;
    const double expected =
        0.5 * (scene.current->profile(2.0 - below - 0.125) + scene.current->profile(2.0 - below - 0.375));
    largest = std::max(largest, std::abs(mean_speed(world, below, layer == 3 ? 100.0 : above) - expected));
  }
  return largest;
}

TEST_P(ShearedCurrent, HoldsItsProfile) {
  // What particles mix across layers within the relaxation's time: with eight particles over the depth up to 7 % of the
  // surface's velocity with the default of 5 s.
  const double usual = refusal(GetParam(), CurrentSettings{}.relaxation), hard = refusal(GetParam(), 1.0);
  EXPECT_LT(usual, 0.08);
  EXPECT_LT(hard, 0.06);  // 5.0 % linear, 4.2 to 4.7 % by the power law, as compilers round
}

INSTANTIATE_TEST_SUITE_P(Shears, ShearedCurrent, testing::Values(CurrentShear::kLinear, CurrentShear::kSeventhPower),
                         [](const auto& entry) { return entry.param == CurrentShear::kLinear ? "Linear" : "Power"; });

TEST(CurrentInAChannel, IsTheSameBitsForAnyNumberOfThreads) {
  Scene scene = channel();
  scene.current = easterly(1.0);
  scene.current->shear = CurrentShear::kLinear;
  scene.current->depth = 3.0;
  World one(scene, {1, nullptr, {}}), seven(scene, {7, nullptr, {}});
  for (int step = 0; step < 60; ++step) {
    if (step == 20)
      for (World* world : {&one, &seven}) static_cast<void>(test::give(*world, SetCurrent{easterly(0.4), 0.3}));
    one.advance();
    seven.advance();
    ASSERT_EQ(state_hash(one.fluid().particles), state_hash(seven.fluid().particles)) << step;
  }
}

TEST(CurrentInAChannel, ComesToRestWhenCleared) {
  Scene scene = channel();
  scene.current = easterly(1.0);
  scene.current->relaxation = 0.5;
  World world(scene, {2, nullptr, {}});
  static_cast<void>(test::give(world, ClearCurrent{}));
  EXPECT_FALSE(world.current());
  EXPECT_EQ(world.current_at({1, 1, 1}, 0.0), Eigen::Vector3d::Zero());
  advance_to(world, 3.0);  // e^-6
  EXPECT_NEAR(mean_speed(world), 0.0, 0.01);
}

TEST(CurrentInAChannel, CostsNothingWhereThereIsNone) {
  const auto clock = []() -> std::int64_t {
    static std::int64_t ticks = 0;
    return ++ticks;
  };
  const auto stage = static_cast<std::size_t>(Stage::kCurrent);
  World still(channel(), {1, clock, {}});
  EXPECT_EQ(still.advance().report.times.ns[stage], 0);
  Scene scene = channel();
  scene.current = easterly(1.0);
  World flowing(scene, {1, clock, {}});
  EXPECT_GT(flowing.advance().report.times.ns[stage], 0);
  scene.patch_edges = kWallsAround;  // nothing flows, so nothing is held
  World walled(scene, {1, clock, {}});
  EXPECT_EQ(walled.advance().report.times.ns[stage], 0);
}

TEST(CurrentInAPatch, MovesWhatDriftsAndNotTheWater) {
  Scene scene = test::small_patch();
  scene.current = easterly(1.0);
  World world(scene, {2, nullptr, {}});
  EXPECT_EQ(mean_speed(world), 0.0);
  EXPECT_TRUE(world.current_at({1, 1, 1}, 0.0).isApprox(Eigen::Vector3d(1, 0, 0), kRounding));
  EXPECT_TRUE(world.unresolved_current_at({1, 1, 1}, 0.0).isApprox(Eigen::Vector3d(1, 0, 0), kRounding));
  advance_to(world, 0.5);
  EXPECT_LT(std::abs(mean_speed(world)), 0.01);
}

TEST(CurrentInAChannel, GoesRoundABodyThatStands) {
  const test::CubeFile cube;
  Scene scene = channel();
  scene.patch = {{0, 0, 0}, {12, 4, 4}};
  scene.water.blocks = {{{0, 0, 0}, {12, 4, 2}}};
  scene.current = easterly(1.0);
  BodySettings body;
  body.id = 1;
  body.name = "cube";
  body.mesh_file = cube.path();
  body.drive = BodyDrive::kStatic;
  body.position = {6.0, 2.0, 1.0};
  scene.bodies = {body};
  World world(scene, {2, nullptr, {}});
  advance_to(world, 4.0);
  // Behind the cube's middle the water lags, beside it it does not.
  double behind = 0.0, beside = 0.0, count_behind = 0.0, count_beside = 0.0;
  const FluidParticles& p = world.fluid().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Eigen::Vector3d x = Eigen::Vector3d(p.position[i].x, p.position[i].y, p.position[i].z) + world.patch().origin;
    if (x.x() < 6.7 || x.x() > 7.7 || std::abs(x.z() - 1.0) > 0.5) continue;
    const bool in_lee = std::abs(x.y() - 2.0) < 0.4;
    (in_lee ? behind : beside) += static_cast<double>(p.velocity[i].x);
    (in_lee ? count_behind : count_beside) += 1.0;
  }
  ASSERT_GT(count_behind, 0.0);
  ASSERT_GT(count_beside, 0.0);
  EXPECT_LT(behind / count_behind, 0.7 * beside / count_beside);
}

TEST(WorldCommands, DoWhatTheySay) {
  World world(channel(), {1, nullptr, {}});
  SetWind wind;
  wind.wind.velocity = {5, 0, 0};
  ASSERT_EQ(test::give(world, wind), std::nullopt);
  EXPECT_EQ(world.wind()->velocity.x(), 5.0);
  ASSERT_EQ(test::give(world, ClearWind{}), std::nullopt);
  EXPECT_FALSE(world.wind());
  ASSERT_EQ(test::give(world, SetCurrent{easterly(2.0), 0.0}), std::nullopt);
  EXPECT_NEAR(world.current()->velocity.x(), 2.0, kRounding);
  ASSERT_EQ(test::give(world, ClearCurrent{}), std::nullopt);
  EXPECT_FALSE(world.current());
  ASSERT_EQ(test::give(world, SetEffort{{0.003, 1e-3, 2e-3}, ""}), std::nullopt);
  EXPECT_EQ(world.effort(), (Effort{0.003, 1e-3, 2e-3}));
  ASSERT_EQ(test::give(world, PauseSimulation{}), std::nullopt);
  EXPECT_GT(world.advance().report.dt, 0.0);
}

}  // namespace
}  // namespace pelagos
