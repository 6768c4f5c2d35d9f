#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "renderer/moving_hulls.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {
namespace {

const std::map<std::uint32_t, HullBox> kBoxes = {{1, {{-18, -4.5, -3}, {18, 4.5, 6}}}};

BodyState ship(const Eigen::Vector3d& velocity) {
  BodyState body;
  body.body = 1;
  body.velocity = velocity;
  return body;
}

MovingHull hull_of(const BodyState& body, const WaveField& sea = {}, const Eigen::Vector2d& flow = {0, 0}) {
  const std::vector<MovingHull> hulls = moving_hulls({&body, 1}, kBoxes, sea.at(0.0, {0, 0}), {0, 0}, 0.0, flow);
  return hulls.empty() ? MovingHull() : hulls.front();
}

TEST(MovingHulls, SpeedIsThatThroughTheWater) {
  const MovingHull ahead = hull_of(ship({5, 0, 0}), {}, {-2, 0});
  EXPECT_NEAR(ahead.speed, 7.0, 1e-9);
  EXPECT_NEAR(ahead.half_beam, 4.5, 1e-9);
  const MovingHull astern = hull_of(ship({-3, 0, 0}));
  EXPECT_NEAR(astern.speed, 3.0, 1e-9);
  EXPECT_NEAR(astern.way.x(), -1.0, 1e-9) << "the stern is her bow";
}

TEST(MovingHulls, LeavesOutWhatDoesNotStandInTheSurface) {
  BodyState body = ship({5, 0, 0});
  body.position.z() = 30.0;
  EXPECT_TRUE(moving_hulls({&body, 1}, kBoxes, WaveField().at(0.0, {0, 0}), {0, 0}, 0.0, {0, 0}).empty());
  body.position.z() = 0.0;
  body.body = 2;
  EXPECT_TRUE(moving_hulls({&body, 1}, kBoxes, WaveField().at(0.0, {0, 0}), {0, 0}, 0.0, {0, 0}).empty()) << "no mesh";
}

TEST(MovingHulls, SlamsWhereBowAndWaterMeet) {
  EXPECT_NEAR(hull_of(ship({7, 0, 0})).slam, 0.0, 1e-6) << "calm water";
  BodyState pitching = ship({7, 0, 0});
  pitching.angular_velocity.y() = 0.1;  // bow down
  EXPECT_NEAR(hull_of(pitching).slam, 1.8, 1e-6);
  pitching.angular_velocity.y() = -0.1;
  EXPECT_LT(hull_of(pitching).slam, 0.0);
  pitching.angular_velocity.y() = 0.1;
  pitching.position.z() = 5.0;  // a bow that stands clear of the water
  EXPECT_NEAR(hull_of(pitching).slam, 0.0, 1e-6);
}

}  // namespace
}  // namespace pelagos
