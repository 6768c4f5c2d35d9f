#include <gtest/gtest.h>

#include <random>

#include "pelagos_dds/frames.hpp"
#include "wire/convert.hpp"

namespace pelagos {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr double kRounding = 1e-12;  // some multiplications of numbers around 1 in double

Vector3d forward(const Quaterniond& q) { return q * Vector3d::UnitX(); }

TEST(WorldFrames, AxesSwapAsNamed) {
  EXPECT_EQ(swap_enu_ned(Vector3d(1.0, 2.0, 3.0)), Vector3d(2.0, 1.0, -3.0));  // east 1, north 2, up 3
  EXPECT_EQ(swap_port_starboard(Vector3d(1.0, 2.0, 3.0)), Vector3d(1.0, -2.0, -3.0));
}

TEST(WorldFrames, NedIdentityIsAShipHeadingNorth) {
  const Quaterniond enu = swap_enu_ned(Quaterniond::Identity());
  EXPECT_TRUE(forward(enu).isApprox(Vector3d::UnitY(), kRounding));                // bow to the north
  EXPECT_TRUE((enu * Vector3d::UnitY()).isApprox(-Vector3d::UnitX(), kRounding));  // port to the west
  EXPECT_TRUE((enu * Vector3d::UnitZ()).isApprox(Vector3d::UnitZ(), kRounding));   // up stays up
  // The contract says: a turn of +90 degrees about z.
  EXPECT_LT(enu.angularDistance(Quaterniond(Eigen::AngleAxisd(kHalfTurn / 2, Vector3d::UnitZ()))), 1e-7);
}

TEST(WorldFrames, SwapTwiceIsTheSame) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const Quaterniond q =
        Quaterniond(normal(generator), normal(generator), normal(generator), normal(generator)).normalized();
    EXPECT_NEAR(std::abs(swap_enu_ned(swap_enu_ned(q)).dot(q)), 1.0, kRounding);
    // A vector fixed to the body ends in the same place whichever frame it goes through.
    const Vector3d v(normal(generator), normal(generator), normal(generator));
    EXPECT_TRUE(swap_enu_ned(Vector3d(q * v)).isApprox(swap_enu_ned(q) * swap_port_starboard(v), kRounding));
  }
}

TEST(WorldFrames, HeadingPitchAndRollTurnTheShipTheSeamansWay) {
  const double angle = 0.2;
  const Quaterniond east = orientation_from_heading(kHalfTurn / 2, 0.0, 0.0);
  EXPECT_TRUE(forward(east).isApprox(Vector3d::UnitX(), kRounding));
  EXPECT_LT(east.angularDistance(Quaterniond::Identity()), 1e-7);                                   // acos near 1
  EXPECT_NEAR(forward(orientation_from_heading(0.0, angle, 0.0)).z(), std::sin(angle), kRounding);  // bow up
  // Roll to starboard: the port side (+y) comes up.
  EXPECT_NEAR((orientation_from_heading(0.0, 0.0, angle) * Vector3d::UnitY()).z(), std::sin(angle), kRounding);
}

BodyPose some_pose() {
  BodyPose pose;
  pose.body = 3;
  pose.time = 12.5;
  pose.position = {100.0, 200.0, -3.0};
  pose.orientation = orientation_from_heading(0.7, 0.1, -0.2);
  pose.velocity = {1.0, 5.0, 0.3};
  pose.angular_velocity = {0.01, -0.02, 0.05};
  return pose;
}

TEST(PoseConversion, RoundTripInBothFrames) {
  for (const pelagos_WorldFrame frame : {pelagos_FRAME_ENU, pelagos_FRAME_NED}) {
    const BodyPose sent = some_pose();
    const pelagos_PoseV1 wire = wire::to_wire(sent, 17, frame);
    EXPECT_EQ(wire.sender, 17U);
    EXPECT_EQ(wire.frame, frame);
    const BodyPose pose = wire::from_wire(wire);
    EXPECT_EQ(pose.body, 3U);
    EXPECT_EQ(pose.time, 12.5);
    EXPECT_TRUE(pose.position.isApprox(sent.position, kRounding));
    EXPECT_NEAR(std::abs(pose.orientation.dot(sent.orientation)), 1.0, kRounding);
    EXPECT_TRUE(pose.velocity.isApprox(sent.velocity, kRounding));
    EXPECT_TRUE(pose.angular_velocity.isApprox(sent.angular_velocity, kRounding));
  }
}

TEST(PoseConversion, NedSampleOfATurningShipMeansWhatItSays) {
  // Heading north at 5 m/s, 30 m north and 10 m east of the origin, 2 m below it, turning to starboard.
  pelagos_PoseV1 wire{};
  wire.body = 1;
  wire.frame = pelagos_FRAME_NED;
  wire.position = {30.0, 10.0, 2.0};
  wire.orientation = {0.0, 0.0, 0.0, 1.0};
  wire.velocity = {5.0, 0.0, 0.0};
  wire.angular_rate_body = {0.0, 0.0, 0.1};
  const BodyPose pose = wire::from_wire(wire);
  EXPECT_TRUE(pose.position.isApprox(Vector3d(10.0, 30.0, -2.0), kRounding));
  EXPECT_TRUE(pose.velocity.isApprox(Vector3d(0.0, 5.0, 0.0), kRounding));
  EXPECT_TRUE(forward(pose.orientation).isApprox(Vector3d::UnitY(), kRounding));
  // To starboard is clockwise from above: about -z in ENU.
  EXPECT_TRUE(pose.angular_velocity.isApprox(Vector3d(0.0, 0.0, -0.1), kRounding));
}

TEST(LoadConversion, RoundTripInBothFrames) {
  BodyLoad load;
  load.body = 3;
  load.point = {1.0, 2.0, 3.0};
  load.force = {4.0, 5.0, 6.0};
  load.moment = {7.0, 8.0, 9.0};
  load.buoyant_force = {0.0, 0.5, 5.5};
  load.buoyant_moment = {0.1, 0.2, 0.3};
  load.peak_force = 20.0;
  load.peak_moment = 30.0;
  load.wetted_volume = 0.6;
  load.wetted_area = 1.2;
  Snapshot snapshot;
  snapshot.frame = 12;
  snapshot.simulation_time = 0.4;
  for (const pelagos_WorldFrame frame : {pelagos_FRAME_ENU, pelagos_FRAME_NED}) {
    const pelagos_BodyLoadV1 wire = wire::to_wire(load, snapshot, 17, frame);
    EXPECT_EQ(wire.source, 17U);
    EXPECT_EQ(wire.frame, 12U);
    EXPECT_EQ(wire.simulation_time, 0.4);
    // A push to port is one to -y where y is starboard; a push up is one to -z where z is down.
    EXPECT_EQ(wire.force.y, frame == pelagos_FRAME_NED ? -5.0 : 5.0);
    EXPECT_EQ(wire.force.z, frame == pelagos_FRAME_NED ? -6.0 : 6.0);
    const BodyLoad back = wire::from_wire(wire);
    EXPECT_EQ(back.body, 3U);
    for (const auto member :
         {&BodyLoad::point, &BodyLoad::force, &BodyLoad::moment, &BodyLoad::buoyant_force, &BodyLoad::buoyant_moment})
      EXPECT_EQ(back.*member, load.*member);
    for (const auto member :
         {&BodyLoad::peak_force, &BodyLoad::peak_moment, &BodyLoad::wetted_volume, &BodyLoad::wetted_area})
      EXPECT_EQ(back.*member, load.*member);
  }
}

TEST(WindConversion, DirectionIsStatedBothWays) {
  const pelagos_WindSettingsV1 wire = wire::to_wire(WindSettings{.velocity = wind_velocity(10.0, 315.0), .pulse = {}});
  EXPECT_NEAR(wire.wind_speed, 10.0, kRounding * 10);
  EXPECT_NEAR(wire.wind_from_deg, 315.0, 1e-10);
  EXPECT_GT(wire.velocity_to.x, 0.0);  // from north-west: blows to the east ...
  EXPECT_LT(wire.velocity_to.y, 0.0);  // ... and south
}

TEST(WindConversion, APulseInStepsIsNotToldInSeconds) {
  WindSettings wind;
  wind.pulse = WindPulse{10.0, 4.0};
  EXPECT_TRUE(wire::to_wire(wind).has_pulse);
  wind.law = WindLaw::kPaper;
  EXPECT_FALSE(wire::to_wire(wind).has_pulse);
}

}  // namespace
}  // namespace pelagos
