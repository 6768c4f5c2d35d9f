// A patch of an open sea: its water at the start, its edges, and the way it follows.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/fluid.hpp"
#include "same_run.hpp"
#include "simulation/open_sea.hpp"
#include "simulation/world.hpp"
#include "small_patch.hpp"
#include "waves/dispersion.hpp"

namespace pelagos {
namespace {

using test::expect_same_run;

/// 28 x 26 x 5 m of an open sea, d = 1 m: 3,640 particles.
Scene open_patch(double amplitude = 0.4, double length = 30.0) {
  Scene scene;
  scene.name = "open_patch";
  scene.particle_spacing = 1.0;
  scene.patch = {{-14, -13, -5}, {14, 13, 8}};
  scene.patch_edges = {PatchEdge::kOpen, PatchEdge::kOpen, PatchEdge::kWall};
  scene.water.blocks = {{{-14, -13, -5}, {14, 13, 0}}};
  scene.open_sea.zone_width = 5.0;
  if (amplitude > 0.0) scene.far_sea.waves = {{amplitude, length, 0.0, 60.0, 0.0}};
  return scene;
}

Scene following(double speed_x, double speed_y) {
  Scene scene = open_patch();
  scene.open_sea.follow_velocity = {speed_x, speed_y};
  return scene;
}

void run(World& world, double seconds) {
  while (world.time() < seconds) ASSERT_EQ(world.advance().fault, StepFault::kNone) << world.time();
}

/// Surface of the drawn waves over a place, m above the mean level.
double wave_height(const World& world, const Eigen::Vector2d& place) {
  const WaveMoment moment = world.sea().at(world.time(), place);
  const float x = 0.0F, y = 0.0F;
  float height = 0, sx = 0, sy = 0, u = 0, v = 0, w = 0;
  evaluate_displaced_surface(moment, {&x, 1}, {&y, 1}, {{&height, 1}, {&sx, 1}, {&sy, 1}, {&u, 1}, {&v, 1}, {&w, 1}});
  return static_cast<double>(height);
}

/// Root mean square of the water's surface against the waves', over the middle of the patch, and the waves' own.
struct SurfaceError {
  double error = 0.0, waves = 0.0;
};
SurfaceError surface_error(World& world) {
  SurfaceError result;
  TaskPool pool(1);
  WaterSurface surface(pool, {world.patch(), world.fluid().parameters.patch, {}});
  std::vector<SurfacePlace> places;
  for (double x = -5.0; x <= 5.0; x += 2.5)
    for (double y = -4.0; y <= 4.0; y += 2.0) places.push_back({{x, y}, {}});
  const std::vector<SurfaceReading> readings = surface.read_particles(world.fluid(), places);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_TRUE(readings[k].wet);
    const double waves = wave_height(world, world.patch().to_world(places[k].local));
    result.error += std::pow(world.patch().world_height(readings[k].height) - world.water_level() - waves, 2);
    result.waves += waves * waves;
  }
  const auto count = static_cast<double>(places.size());
  return {std::sqrt(result.error / count), std::sqrt(result.waves / count)};
}

TEST(OpenSea, StartsAsTheWavesHaveIt) {
  World world(open_patch(), {2, nullptr, {}});
  EXPECT_EQ(world.water_level(), 0.0);
  EXPECT_EQ(world.fluid().particles.count, 3640U);
  EXPECT_EQ(world.fluid().held.rows.size(), 3640U - 22 * 20 * 5);
  const SurfaceError at_start = surface_error(world);
  EXPECT_GT(at_start.waves, 0.15);
  EXPECT_LT(at_start.error, 0.04);
}

TEST(OpenSea, CarriesTheWavesThroughThePatch) {
  World world(open_patch(), {2, nullptr, {}});
  double error = 0.0, waves = 0.0;
  for (int second = 1; second <= 12; ++second) {
    run(world, second);
    const SurfaceError now = surface_error(world);
    error += now.error * now.error;
    waves += now.waves * now.waves;
  }
  EXPECT_LT(std::sqrt(error / waves), 0.2) << "a patch of 20 m inside, waves of 30 m";
}

TEST(OpenSea, WithoutWavesStaysFlat) {
  World world(open_patch(0.0), {2, nullptr, {}});
  run(world, 5.0);
  EXPECT_LT(surface_error(world).error, 0.05);
}

TEST(OpenSea, LeavesOutWavesTooShortForTheParticles) {
  World world(open_patch(0.3, 7.9), {1, nullptr, {}});
  EXPECT_EQ(world.sea().components().size(), 1U) << "outside they are";
  EXPECT_LT(surface_error(world).error, 0.3) << "inside the water starts flat";
  for (std::size_t i = 0; i < world.fluid().particles.count; ++i)
    EXPECT_EQ(world.fluid().particles.velocity[i].z, 0.0F);
}

TEST(OpenSea, HasTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    World world(following(6.0, -3.0), {threads, nullptr, {}});
    run(world, 1.5);
    hashes.push_back(state_hash(world.fluid().particles));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(OpenSea, GoesOnFromAFile) { expect_same_run(following(7.0, 4.0), 30, 60); }

TEST(OpenSea, FollowsATrackByWholeSpacings) {
  World world(following(8.0, -5.0), {2, nullptr, {}});
  std::uint64_t renewed = 0;
  double last_x = 0.0;
  while (world.time() < 6.0) {
    ASSERT_EQ(world.advance().fault, StepFault::kNone);
    const Eigen::Vector2d lag = world.time() * Eigen::Vector2d(8.0, -5.0) - world.patch().middle();
    EXPECT_LT(lag.cwiseAbs().maxCoeff(), 1.3);
    if (world.patch().origin.x() != last_x) ++renewed;
    last_x = world.patch().origin.x();
    EXPECT_EQ(std::round(last_x), last_x);
  }
  EXPECT_GE(renewed, 46U);
  EXPECT_NEAR(static_cast<double>(world.fluid().particles.count), 3640.0, 40.0);
  const SurfaceError error = surface_error(world);
  EXPECT_LT(error.error, 0.06) << "water that is renewed is quieter than water at rest";
}

TEST(OpenSea, IsTheSameFarFromTheOrigin) {
  Scene near = following(6.0, 2.0), far = near;
  const double away = 1024.0 * 1024.0 * 0.9375;  // 983 km, whole metres: waves of 32 m repeat there
  near.far_sea.waves = far.far_sea.waves = {{0.4, 32.0, 0.0, 90.0, 0.0}};
  far.patch.min.x() += away, far.patch.max.x() += away;
  far.water.blocks[0].min.x() += away, far.water.blocks[0].max.x() += away;
  World one(near, {2, nullptr, {}}), other(far, {2, nullptr, {}});
  run(one, 3.0);
  run(other, 3.0);
  EXPECT_NEAR(other.patch().origin.x() - one.patch().origin.x(), away, 1e-6);
  EXPECT_LT(surface_error(other).error, 0.06);
}

TEST(OpenSea, TellsHowItFollowsTheWaves) {
  World world(following(5.0, 0.0), {2, nullptr, {}});
  EXPECT_FALSE(World(test::small_patch(), {1, nullptr, {}}).edge_quality().has_value()) << "not of a tank";
  run(world, 4.0);
  EXPECT_FALSE(world.edge_quality()->height_ratio) << "a moment tells nothing of waves";
  run(world, 7.0);
  const EdgeQuality quality = world.edge_quality().value();
  ASSERT_TRUE(quality.height_ratio.has_value());
  EXPECT_NEAR(*quality.height_ratio, 1.0, 0.12);
  EXPECT_NEAR(quality.significant_height, 4.0 * 0.4 / std::sqrt(2.0), 1e-6);
  EXPECT_LT(std::abs(quality.level), 0.1);
  EXPECT_GT(quality.mismatch, 0.001);
  EXPECT_LT(quality.mismatch, 0.2);
  EXPECT_GE(quality.created, 29U * 26U * 5U) << "one column for each metre";
  EXPECT_GT(quality.deleted, 3000U);
}

TEST(OpenSea, StartsAnewUnderABodyThatJumps) {
  const test::CubeFile cube;
  Scene scene = open_patch();
  BodySettings body;
  body.id = 1;
  body.name = "cube";
  body.mesh_file = cube.path();
  body.mesh_scale = 3.0;
  body.position = {0.0, 0.0, 0.0};
  scene.bodies = {body};
  scene.open_sea.follow_body = 1;
  World world(scene, {2, nullptr, {}});
  run(world, 0.5);
  StepInputs inputs;
  BodyPose pose;
  pose.body = 1;
  pose.time = 0.0;
  pose.position = {4000.0, -250.0, 0.0};
  inputs.poses.push_back({pose, {}});
  ASSERT_EQ(world.advance(inputs).fault, StepFault::kNone);
  run(world, 2.0);
  EXPECT_LT((world.patch().middle() - Eigen::Vector2d(4000.0, -250.0)).norm(), 2.0);
  EXPECT_NEAR(static_cast<double>(world.fluid().particles.count), 3640.0 - 14.0, 25.0);
  EXPECT_EQ(world.measure().not_finite, 0U);
}

}  // namespace
}  // namespace pelagos
