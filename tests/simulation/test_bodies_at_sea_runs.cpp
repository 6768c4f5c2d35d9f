// Bodies that the wave field carries, outside the water of an open patch and across its edges: seconds of real physics.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <vector>

#include "rigid/triangle_mesh.hpp"
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

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The angle of a body's axis above the horizontal, rad.
double rise_of(const BodyState& state, const Eigen::Vector3d& axis) {
  return std::asin((state.orientation * axis).z());
}

TEST(BodiesAtSeaRuns, ABargeFloatsAtItsDraftByArchimedes) {
  BodySettings body = barge({8.0, 4.0, 2.0}, {60.0, 0.0, 0.3});
  World world(with_body(edged_patch(), body), {2, nullptr, {}});
  sail(world, 30.0);
  EXPECT_NEAR(1.0 - first_body(world).position.z(), 1.0, 0.005) << "draft";
  EXPECT_LT(first_body(world).velocity.norm(), 0.01);
  EXPECT_NEAR(rise_of(first_body(world), Eigen::Vector3d::UnitX()), 0.0, 1e-3);
  EXPECT_NEAR(first_body(world).position.x(), 60.0, 1e-3) << "calm water does not move it";
}

TEST(BodiesAtSeaRuns, FollowsAWaveOfTwentyTimesItsLength) {
  const double length = 160.0, amplitude = 1.5;
  // A quarter of the wave east of a crest: the level is the mean one, and the water rises without going along.
  const Eigen::Vector3d start(0.25 * length, 0.0, 0.0);
  Scene scene = with_body(edged_patch(), barge({8.0, 4.0, 2.0}, start));
  scene.far_sea.waves = {{amplitude, length, 0.0, 90.0, 0.0}};  // eastwards
  World world(scene, {2, nullptr, {}});
  const double period = kTurn / std::sqrt(kStandardGravity * kTurn / length);
  sail(world, 3.0 * period);
  double heave = 0.0, pitch = 0.0, count = 0.0;
  sail(world, 7.0 * period, [&] {
    heave += std::pow(first_body(world).position.z(), 2);
    pitch += std::pow(rise_of(first_body(world), Eigen::Vector3d::UnitX()), 2);
    count += 1.0;
  });
  EXPECT_NEAR(std::sqrt(2.0 * heave / count), amplitude, 0.03 * amplitude);
  const double slope = amplitude * kTurn / length;
  EXPECT_NEAR(std::sqrt(2.0 * pitch / count), slope, 0.05 * slope);
  EXPECT_LT((first_body(world).position - start).head<2>().norm(), 2.0 * amplitude)
      << "it goes to and fro with the water";
}

TEST(BodiesAtSeaRuns, ALedBodyHeavesRollsAndPitchesWhereItIsLed) {
  const double length = 160.0, amplitude = 1.5;
  const Eigen::Vector3d start(0.25 * length, 0.0, 0.0);
  Scene scene = with_body(edged_patch(), barge({8.0, 4.0, 2.0}, start, BodyDrive::kPoseHorizontal));
  scene.far_sea.waves = {{amplitude, length, 0.0, 90.0, 0.0}};
  World world(scene, {2, nullptr, {}});
  const double period = kTurn / std::sqrt(kStandardGravity * kTurn / length);
  sail(world, 2.0 * period);
  double heave = 0.0, count = 0.0;
  sail(world, 5.0 * period, [&] {
    heave += std::pow(first_body(world).position.z(), 2);
    count += 1.0;
    ASSERT_EQ(first_body(world).position.x(), start.x());
  });
  EXPECT_NEAR(std::sqrt(2.0 * heave / count), amplitude, 0.03 * amplitude);
}

TEST(BodiesAtSeaRuns, HeavesWithThePeriodOfItsStiffnessAndMass) {
  const Eigen::Vector3d size(8.0, 4.0, 2.0);
  World world(with_body(edged_patch(), barge(size, {60.0, 0.0, 0.2})), {2, nullptr, {}});
  const SeaBody at_sea = make_sea_body(make_mesh(BoxShape{size}), 32.0e3, kSeaDensity);
  const double whole = 32.0e3 * (1.0 + at_sea.added.along.z()), stiffness = kSeaDensity * kStandardGravity * 32.0;
  const double damped = std::sqrt(stiffness / whole) * std::sqrt(1.0 - kHeaveDamping * kHeaveDamping);
  std::vector<double> crossings;
  double last = first_body(world).position.z(), last_time = 0.0;
  sail(world, 12.0, [&] {
    const double now = first_body(world).position.z();
    if (last > 0.0 && now <= 0.0) crossings.push_back(last_time + (world.time() - last_time) * last / (last - now));
    last = now, last_time = world.time();
  });
  ASSERT_GE(crossings.size(), 3U);
  EXPECT_NEAR(crossings[2] - crossings[1], kTurn / damped, 0.04 * kTurn / damped) << "drag adds a little";
}

TEST(BodiesAtSeaRuns, RollsItselfToRest) {
  BodySettings body = barge({8.0, 4.0, 2.0}, {60.0, 0.0, 0.0});
  body.orientation =
      Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
  World world(with_body(edged_patch(), body), {2, nullptr, {}});
  double least = 0.0;
  sail(world, 35.0, [&] { least = std::min(least, rise_of(first_body(world), Eigen::Vector3d::UnitY())); });
  EXPECT_LT(least, -0.05) << "it swings over";
  EXPECT_NEAR(rise_of(first_body(world), Eigen::Vector3d::UnitY()), 0.0, 0.005);
  EXPECT_NEAR(rise_of(first_body(world), Eigen::Vector3d::UnitX()), 0.0, 0.005);
  EXPECT_LT(first_body(world).angular_velocity.head<2>().norm(), 0.005);
}

TEST(BodiesAtSeaRuns, DriftsWithTheCurrent) {
  Scene scene = with_body(edged_patch(), barge({8.0, 4.0, 2.0}, {60.0, 0.0, 0.0}));
  scene.current = CurrentSettings{{0.0, 1.0, 0.0}, CurrentShear::kNone, 0.0, 5.0};
  scene.bodies[0].velocity = {0.0, -1.0, 0.0};  // beside the current: it starts at rest
  World world(scene, {1, nullptr, {}});
  EXPECT_NEAR(first_body(world).velocity.y(), 0.0, 0.01);
  sail(world, 60.0);
  EXPECT_NEAR(first_body(world).velocity.y(), 1.0, 0.1);
}

TEST(BodiesAtSeaRuns, AMeshOfManyTrianglesFloatsAsItsHydrostaticsSay) {
  TriangleMesh sphere = make_mesh(SphereShape{2.0});  // more than 2,000 triangles
  ASSERT_GT(sphere.triangles.size(), 2000U);
  const SeaPanels panels = make_sea_panels(sphere);
  EXPECT_LT(panels.mesh.triangles.size(), 2000U);
  EXPECT_NEAR(mesh_volume(panels.mesh), mesh_volume(sphere), 1e-9 * mesh_volume(sphere));
  BodySettings body = barge({1.0, 1.0, 1.0}, {60.0, 0.0, 0.0});
  body.primitive = SphereShape{2.0};
  World world(with_body(edged_patch(), body), {1, nullptr, {}});
  sail(world, 30.0);
  EXPECT_NEAR(first_body(world).position.z(), 0.0, 0.01) << "half of it is wet";
}

TEST(BodiesAtSeaRuns, AHoldStaysDry) {
  Scene scene = edged_patch();
  // A box of 6 x 4 x 2 m with a hold of 5 x 3 x 1.6 m, open above.
  const std::string path = testing::TempDir() + "pelagos_open_boat_" + std::to_string(getpid()) + ".obj";
  std::ofstream(path) << "v -3 -2 -1\nv 3 -2 -1\nv 3 2 -1\nv -3 2 -1\nv -3 -2 1\nv 3 -2 1\nv 3 2 1\nv -3 2 1\n"
                         "v -2.5 -1.5 -0.6\nv 2.5 -1.5 -0.6\nv 2.5 1.5 -0.6\nv -2.5 1.5 -0.6\n"
                         "v -2.5 -1.5 1\nv 2.5 -1.5 1\nv 2.5 1.5 1\nv -2.5 1.5 1\n"
                         "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
                         "f 9 10 11 12\nf 9 13 14 10\nf 10 14 15 11\nf 11 15 16 12\nf 12 16 13 9\n"
                         "f 5 6 14 13\nf 6 7 15 14\nf 7 8 16 15\nf 8 5 13 16\n";
  BodySettings body = barge({1, 1, 1}, {60.0, 0.0, 0.3});
  body.primitive.reset();
  body.mesh_file = path;
  body.mass = {};
  body.mass.mass = 24.0e3;  // a draft of 1 m
  World world(with_body(scene, body), {1, nullptr, {}});
  std::filesystem::remove(path);
  sail(world, 30.0);
  EXPECT_NEAR(first_body(world).position.z(), 0.0, 0.01);
}

TEST(BodiesAtSeaRuns, CalmWaterHoldsABodyThatIsTowedOut) {
  const Eigen::Vector3d size(10.0, 6.0, 6.0);
  World world(with_body(deep_edged_patch(), barge(size, {0.0, 0.0, 0.0}, BodyDrive::kPose)), {2, nullptr, {}});
  const double weight = 0.5 * kSeaDensity * size.prod() * kStandardGravity, speed = 1.0, start = 4.0;
  double worst = 0.0, sum = 0.0, count = 0.0;
  while (world.time() < 32.0) {
    StepInputs inputs;
    BodyPose pose;
    pose.body = 1;
    pose.time = world.time();
    pose.position = {std::max(0.0, world.time() - start) * speed, 0.0, 0.0};
    pose.velocity = {world.time() > start ? speed : 0.0, 0.0, 0.0};
    inputs.poses.push_back({pose, {}});
    WorldStep step = world.advance(inputs);
    ASSERT_EQ(step.fault, StepFault::kNone);
    if (!step.frame_reached) continue;
    Snapshot snapshot;
    world.take_frame(snapshot, step.report);
    sum += snapshot.loads[0].force.z(), count += 1.0;
    if (count < 30.0) continue;  // means of a second
    const double off = sum / count / weight - 1.0;
    if (world.time() > start) worst = std::max(worst, std::abs(off));
    sum = count = 0.0;
  }
  EXPECT_LT(worst, 0.03);
}

/// Deepest particle in a body's hull, m.
double deepest_inside(const World& world) {
  double deepest = 0.0;
  std::vector<double> distance;
  const FluidParticles& p = world.fluid().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Eigen::Vector3d x(p.position[i].x, p.position[i].y, p.position[i].z);
    world.bodies().signed_distances(world.patch().to_world(x), 1.0, distance);
    deepest = std::max(deepest, -distance[0]);
  }
  return deepest;
}

TEST(BodiesAtSeaRuns, AShipThatCrossesThePatchLeavesItWhole) {
  Scene scene = with_body(deep_edged_patch(), barge({16.0, 6.0, 5.0}, {-40.0, 1.0, 0.0}, BodyDrive::kPose));
  scene.far_sea.waves = {{0.4, 36.0, 0.0, 60.0, 0.0}};
  World world(scene, {2, nullptr, {}});
  const std::size_t held = world.fluid().held.rows.size(), all = world.fluid().particles.count;
  double deepest = 0.0, next = 0.0;
  while (world.time() < 16.0) {
    StepInputs inputs;
    BodyPose pose;
    pose.body = 1;
    pose.time = world.time();
    pose.position = {-40.0 + 6.0 * world.time(), 1.0, 0.0};
    pose.velocity = {6.0, 0.0, 0.0};
    inputs.poses.push_back({pose, {}});
    ASSERT_EQ(world.advance(inputs).fault, StepFault::kNone);
    if (world.time() < next) continue;
    next = world.time() + 0.25;
    deepest = std::max(deepest, deepest_inside(world));
  }
  EXPECT_GT(first_body(world).position.x(), 45.0);
  EXPECT_LT(deepest, 0.5);
  // Where other water stands in a gap of the rim it stays open: 0.6 % here. 1.2 % of all has run out or was too much.
  EXPECT_NEAR(static_cast<double>(world.fluid().held.rows.size()), static_cast<double>(held),
              0.01 * static_cast<double>(held));
  EXPECT_NEAR(static_cast<double>(world.fluid().particles.count), static_cast<double>(all),
              0.03 * static_cast<double>(all));
}

TEST(BodiesAtSeaRuns, APatchThatPassesOverABodyDoesNotThrowIt) {
  Scene scene = with_body(deep_edged_patch(), barge({6.0, 5.0, 4.0}, {28.0, 1.0, 0.0}));
  scene.far_sea.waves = {{0.5, 36.0, 0.0, 60.0, 0.0}};
  scene.open_sea.follow_velocity = {2.5, 0.0};
  World world(scene, {2, nullptr, {}});
  Eigen::Vector3d last = first_body(world).velocity;
  double next = 0.0, largest = 0.0, deepest = 0.0, held = static_cast<double>(world.fluid().held.rows.size());
  sail(world, 32.0, [&] {
    if (world.time() < next) return;
    const Eigen::Vector3d now = first_body(world).velocity;
    if (next > 0.0) largest = std::max(largest, (now - last).norm() / 0.2);
    deepest = std::max(deepest, deepest_inside(world));
    last = now;
    next = world.time() + 0.2;
  });
  EXPECT_LT(world.patch().to_local(first_body(world).position).x(), -22.0) << "it is behind the patch";
  EXPECT_LT(largest, 2.0) << "m/s^2; the waves' own is 0.84";
  EXPECT_LT(deepest, 0.3);
  EXPECT_NEAR(static_cast<double>(world.fluid().held.rows.size()), held, 0.01 * held);
}

}  // namespace
}  // namespace pelagos
