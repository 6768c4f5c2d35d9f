#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "channels/camera.hpp"
#include "renderer/far_sea.hpp"
#include "renderer/fluid.hpp"

namespace pelagos {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kExact = 1e-12;  // double rounding of a few turns

Channel bridge(double yaw_deg) {
  Channel channel;
  channel.yaw_deg = yaw_deg;
  channel.mount.body = 1;
  channel.mount.eye = {-7.0, 2.0, 9.0};
  return channel;
}

BodyState ship(double heading_from_east_deg) {
  BodyState body;
  body.body = 1;
  body.position = {1000.0, -500.0, 0.5};
  body.orientation = Eigen::AngleAxisd(heading_from_east_deg * kDegree, Eigen::Vector3d::UnitZ());
  return body;
}

TEST(Camera, LooksAheadFromTheBridgeOfAShipThatHeadsNorth) {
  const BodyState body = ship(90.0);
  const Camera camera = camera_for(bridge(0.0), std::span(&body, 1), 640, 360).value();
  // forward is north, so port is west: the eye is 7 m south, 2 m west of the ship's origin and 9 m up
  EXPECT_TRUE(camera.eye.isApprox(Eigen::Vector3d(998.0, -507.0, 9.5), kExact));
  EXPECT_TRUE(camera.view_from_world.row(2).transpose().isApprox(Eigen::Vector3d::UnitY(), kExact));
  EXPECT_TRUE(camera.view_from_world.row(0).transpose().isApprox(Eigen::Vector3d::UnitX(), kExact));
  EXPECT_TRUE(camera.view_from_world.row(1).transpose().isApprox(Eigen::Vector3d::UnitZ(), kExact));
}

TEST(Camera, YawIsPositiveToStarboardAndPitchUp) {
  const BodyState body = ship(0.0);  // heads east
  Channel channel = bridge(90.0);
  Camera camera = camera_for(channel, std::span(&body, 1), 640, 360).value();
  EXPECT_TRUE(camera.ray(0, 0).isApprox(-Eigen::Vector3d::UnitY(), kExact)) << "starboard of east is south";
  channel = bridge(0.0);
  channel.pitch_deg = 30.0;
  camera = camera_for(channel, std::span(&body, 1), 640, 360).value();
  EXPECT_TRUE(camera.ray(0, 0).isApprox(Eigen::Vector3d(std::cos(30 * kDegree), 0, std::sin(30 * kDegree)), kExact));
}

TEST(Camera, FollowsRollAndPitchOnlyIfAsked) {
  BodyState body = ship(0.0);
  body.orientation = body.orientation * Eigen::AngleAxisd(10.0 * kDegree, Eigen::Vector3d::UnitX());
  Channel channel = bridge(0.0);
  Camera camera = camera_for(channel, std::span(&body, 1), 640, 360).value();
  EXPECT_NEAR(camera.view_from_world(0, 2), -std::sin(10.0 * kDegree), kExact) << "starboard side down";
  channel.mount.attitude = MountAttitude::kHeading;
  camera = camera_for(channel, std::span(&body, 1), 640, 360).value();
  EXPECT_NEAR(camera.view_from_world(0, 2), 0.0, kExact);
  EXPECT_NEAR(camera.eye.z(), 9.0, kExact) << "a chase camera does not heave";
}

TEST(Camera, FixedMountUsesCompassHeading) {
  Channel channel;
  channel.mount.eye = {3.0, 4.0, 20.0};
  channel.mount.heading_deg = 180.0;
  const Camera camera = camera_for(channel, {}, 640, 360).value();
  EXPECT_TRUE(camera.ray(0, 0).isApprox(-Eigen::Vector3d::UnitY(), kExact)) << "180 degrees is south";
}

TEST(Camera, NeighbouringChannelsShareTheirBorderUnderTiltAndRoll) {
  BodyState body = ship(33.0);
  body.orientation = body.orientation * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()) *
                     Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitY());
  Channel port = bridge(-40.0), centre = bridge(0.0);
  port.mount.tilt_deg = centre.mount.tilt_deg = -5.0;
  const Camera left = camera_for(port, std::span(&body, 1), 640, 360).value();
  const Camera right = camera_for(centre, std::span(&body, 1), 640, 360).value();
  for (const double y : {-1.0, -0.3, 0.0, 1.0})
    EXPECT_TRUE(left.ray(1.0, y).normalized().isApprox(right.ray(-1.0, y).normalized(), kExact)) << y;
}

TEST(Camera, RefusesABodyThatIsNotThere) { EXPECT_FALSE(camera_for(bridge(0.0), {}, 640, 360).has_value()); }

TEST(Camera, ExtrapolatesBodies) {
  BodyState body = ship(0.0);
  body.velocity = {2.0, 0.0, 0.0};
  body.angular_velocity = {0.0, 0.0, 0.5};
  const BodyState later = extrapolate(body, 0.2);
  EXPECT_NEAR(later.position.x(), 1000.4, kExact);
  EXPECT_NEAR(heading_of(later.orientation), 0.1, kExact);
}

TEST(FluidSize, GuardBandKeepsThePixelsOfThePicture) {
  Camera camera;
  camera.width = 640;
  camera.height = 360;
  camera.guard = 96;
  camera.tan_half_x = 0.364;
  camera.tan_half_y = 0.364 * 360 / 640;
  const FluidSize size = fluid_size_of(camera, 0.5);
  EXPECT_EQ(size.width, 416);
  EXPECT_EQ(size.height, 276);
  // one fluid pixel is two of the picture, in both directions
  EXPECT_NEAR(2 * size.tan_half_x / size.width, 2 * (2 * camera.tan_half_x / camera.width), kExact);
  EXPECT_NEAR(2 * size.tan_half_y / size.height, 2 * (2 * camera.tan_half_y / camera.height), kExact);
}

TEST(FarSeaGrid, ReachesTheHorizonWithoutAHole) {
  for (const double height : {2.0, 8.0, 64.0, 512.0}) {
    const std::vector<float> radii = ring_radii(height, 1.0);
    EXPECT_EQ(radii.front(), 0.0F);
    EXPECT_GE(radii.back(), 30'000.0F);
    EXPECT_LT(radii.size(), 1000u) << height;
    for (std::size_t i = 1; i < radii.size(); ++i) ASSERT_GT(radii[i], radii[i - 1]);
  }
}

TEST(FarSeaGrid, DrawsTheSectorsInViewAndAllWhenLookingDown) {
  const BodyState body = ship(0.0);
  const Camera ahead = camera_for(bridge(0.0), std::span(&body, 1), 640, 360).value();
  const SectorRange some = visible_sectors(ahead, 720);
  EXPECT_LT(some.count, 180);
  EXPECT_EQ((some.first + some.count / 2 + 1) % 720 / 4, 0) << "centred on east, which is sector 0";
  Channel down = bridge(0.0);
  down.pitch_deg = -85.0;
  EXPECT_EQ(visible_sectors(camera_for(down, std::span(&body, 1), 640, 360).value(), 720).count, 720);
}

}  // namespace
}  // namespace pelagos
