#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "renderer/foam_map.hpp"

namespace pelagos {
namespace {

const Eigen::Vector2d kStill = Eigen::Vector2d::Zero();
constexpr double kSpeed = 7.2;  // m/s: fourteen knots

MovingHull coaster(const Eigen::Vector2d& place, double speed) {
  MovingHull hull;
  hull.body = 1;
  hull.place = place;
  hull.half_length = 18.0;
  hull.half_beam = 4.5;
  hull.speed = speed;
  return hull;
}

constexpr double kStopping = 10.0;  // s

/// Of a ship that starts in the origin, goes east at fourteen knots for `seconds`, and then slows down evenly to a
/// stop.
double speed_after(double time, double seconds) {
  return kSpeed * std::clamp(1.0 - (time - seconds) / kStopping, 0.0, 1.0);
}
double place_after(double time, double seconds) {
  const double slows = std::clamp(time - seconds, 0.0, kStopping);
  return kSpeed * (std::min(time, seconds) + slows - 0.5 * slows * slows / kStopping);
}

void sail(FoamMap& map, double from, double to, double step, double stops_after,
          const Eigen::Vector2d& eye_off = kStill) {
  for (double time = from; time < to + 1e-9; time += step) {
    const Eigen::Vector2d place(place_after(time, stops_after), 0.0);
    const MovingHull hull = coaster(place, speed_after(time, stops_after));
    map.advance(time, place + eye_off, kStill, {&hull, 1}, {});
  }
}

TEST(FoamMap, AShipThatStopsKeepsHerWake) {
  FoamMap map;
  sail(map, 0.0, 60.0, 1.0 / 30.0, 30.0);
  // The stern was 60 m behind its last place some 13 s before she stopped.
  const Eigen::Vector2d astern(place_after(60.0, 30.0) - 18.0 - 60.0, 0.0);
  const Eigen::Vector2d left = map.at(astern, 60.0);
  EXPECT_GT(left.x(), 0.15) << "white";
  EXPECT_GT(left.y(), 0.4) << "bubbles";
  EXPECT_GT(map.at(astern, 40.0).x(), left.x()) << "it fades";
  EXPECT_LT(map.at(astern, 240.0).maxCoeff(), 0.15);
  EXPECT_EQ(map.at(astern + Eigen::Vector2d(0, 25), 60.0).maxCoeff(), 0.0) << "beside the wake";
  EXPECT_EQ(map.at(Eigen::Vector2d(place_after(60.0, 30.0) + 40.0, 0.0), 60.0).maxCoeff(), 0.0) << "ahead";
}

TEST(FoamMap, TheWakeWidensAsItAges) {
  FoamMap map;
  sail(map, 0.0, 60.0, 1.0 / 30.0, 60.0);
  const double x = place_after(60.0, 60.0) - 17.0;
  const auto beside = [&](double age) { return map.at({x - kSpeed * age, 6.5}, 60.0).y(); };
  EXPECT_LT(beside(1.5), 0.1);
  EXPECT_GT(beside(40.0), 0.2);
}

TEST(FoamMap, WashTellsTheSpeed) {
  double last = -1.0;
  for (double speed = 0.0; speed < 12.0; speed += 1.0) {
    EXPECT_GT(wash_of(speed), last);
    last = wash_of(speed);
  }
  EXPECT_LT(last, 1.0);
  FoamMap slow, fast;
  const MovingHull slow_hull = coaster(kStill, 2.0), fast_hull = coaster(kStill, kSpeed);
  slow.advance(10.0, kStill, kStill, {&slow_hull, 1}, {});
  fast.advance(10.0, kStill, kStill, {&fast_hull, 1}, {});
  EXPECT_LT(slow.at({-20.0, 0.0}, 10.0).x(), 0.4 * fast.at({-20.0, 0.0}, 10.0).x());
}

TEST(FoamMap, WhoComesLateAssumesThatHullsHaveKeptTheirWay) {
  FoamMap watched, late;
  sail(watched, 0.0, 200.0, 0.1, 1e9);
  sail(late, 200.0, 200.0, 0.1, 1e9);
  for (const double astern : {3.0, 30.0, 100.0, 400.0})
    for (const double across : {0.0, 3.0, 5.0}) {
      const Eigen::Vector2d place(place_after(200.0, 1e9) - 18.0 - astern, across);
      const Eigen::Vector2d seen = watched.at(place, 200.0), assumed = late.at(place, 200.0);
      // half a texel more or less of the wake's edge, 2.5 m in the coarse level
      EXPECT_NEAR(seen.x(), assumed.x(), 0.12) << place.transpose();
      EXPECT_NEAR(seen.y(), assumed.y(), 0.12) << place.transpose();
    }
  FoamMap at_rest;
  const MovingHull hull = coaster(kStill, 0.0);
  at_rest.advance(10.0, kStill, kStill, {&hull, 1}, {});
  EXPECT_FALSE(at_rest.present());
}

TEST(FoamMap, ViewersThatShowOtherInstantsHaveTheSameFoam) {
  FoamMap one, other;
  sail(one, 0.0, 40.0, 1.0 / 60.0, 20.0);
  sail(other, 0.0, 39.9, 0.13, 20.0, {12.0, -7.0});
  sail(other, 40.0, 40.0, 1.0, 20.0, {12.0, -7.0});
  double worst = 0.0;
  for (double x = 80.0; x < 230.0; x += 1.7)  // the fine level of both
    for (double y = -10.0; y <= 10.0; y += 1.3)
      worst = std::max(worst, (one.at({x, y}, 40.0) - other.at({x, y}, 40.0)).cwiseAbs().maxCoeff());
  // Between two instants that are shown she goes straight at a speed that changes evenly; she does so nearly.
  EXPECT_LT(worst, 0.03);
}

TEST(FoamMap, FoamGoesWithTheCurrent) {
  const Eigen::Vector2d current(0.4, -0.8);
  FoamMap map;
  for (double time = 0.0; time < 50.05; time += 0.1) {
    const MovingHull hull = coaster({0.0, 0.0}, time < 10.0 ? kSpeed : 0.0);
    map.advance(time, kStill, current, {&hull, 1}, {});
  }
  // What lay under the stern after 8 s has drifted for 42 s.
  EXPECT_GT(map.at(Eigen::Vector2d(-17.0, 0.0) + 42.0 * current, 50.0).x(), 0.15);
  EXPECT_EQ(map.at({-17.0, 0.0}, 50.0).x(), 0.0);
}

TEST(FoamMap, FoamOfParticlesAndFallingSprayStay) {
  std::vector<SurfaceParticle> particles(3);
  particles[0].foam = 255;
  particles[1].position = {10.0F, 0.0F, 3.0F};
  particles[1].velocity = {0.0F, 0.0F, -4.0F};
  particles[2].position = {-10.0F, 0.0F, 3.0F};
  particles[2].velocity = {0.0F, 0.0F, 4.0F};
  const std::vector<std::uint8_t> loose = {0, 1, 1};
  PatchFoam patch{particles, loose, {100.0, 50.0, 0.0}, 1.0, {40.0, 40.0}, rim_blend(1.0, 80.0)};
  FoamMap map;
  map.advance(1.0, {100.0, 50.0}, kStill, {}, patch);
  map.advance(1.3, {100.0, 50.0}, kStill, {}, patch);
  patch.particles = {};
  patch.loose = {};
  map.advance(5.0, {100.0, 50.0}, kStill, {}, patch);
  EXPECT_GT(map.at({100.1, 50.1}, 5.0).x(), 0.4);
  EXPECT_GT(map.at({110.1, 50.1}, 5.0).x(), 0.3) << "it falls";
  EXPECT_EQ(map.at({90.1, 50.1}, 5.0).x(), 0.0) << "it still rises";
  // At the rim of the patch only the waves around are shown.
  particles[0].position.x() = 39.5F;
  patch.particles = particles;
  map.advance(6.0, {100.0, 50.0}, kStill, {}, patch);
  EXPECT_EQ(map.at({139.6, 50.1}, 6.0).x(), 0.0);
}

TEST(FoamMap, WhatLeavesTheWindowDoesNotComeBackElsewhere) {
  FoamMap map;
  const MovingHull hull = coaster(kStill, kSpeed);
  map.advance(10.0, kStill, kStill, {&hull, 1}, {});
  ASSERT_GT(map.at({-30.0, 0.0}, 10.0).x(), 0.1);
  const double fine = FoamLevel::kSide * map.levels()[0].texel, coarse = FoamLevel::kSide * map.levels()[1].texel;
  for (const double away : {fine, coarse}) {
    map.advance(10.0, {away, 0.0}, kStill, {&hull, 1}, {});
    EXPECT_EQ(map.at({away - 30.0, 0.0}, 10.0).maxCoeff(), 0.0) << away;
  }
  map.advance(10.0, kStill, kStill, {&hull, 1}, {});
  EXPECT_EQ(map.at({-30.0, 0.0}, 10.0).maxCoeff(), 0.0) << "forgotten";
}

TEST(FoamMap, StartsAnewAfterAJumpInTime) {
  for (const double jump : {-3.0, 3600.0}) {
    FoamMap map;
    sail(map, 100.0, 110.0, 0.1, 1e9);
    const Eigen::Vector2d astern(place_after(110.0, 1e9) - 30.0, 0.0);
    ASSERT_GT(map.at(astern, 110.0).x(), 0.3);
    map.advance(110.0 + jump, astern, kStill, {}, {});
    EXPECT_EQ(map.at(astern, 110.0 + jump).maxCoeff(), 0.0);
  }
  FoamMap map;
  sail(map, 100.0, 110.0, 0.1, 1e9);
  sail(map, 109.8, 110.4, 0.1, 1e9);
  EXPECT_GT(map.at({place_after(110.0, 1e9) - 30.0, 0.0}, 110.4).x(), 0.3) << "a picture that is a little earlier";
}

TEST(FoamMap, HoldsItsNumbersForHours) {
  FoamMap map;
  for (double time = 0.0; time < 7200.0; time += 4.0) {
    const MovingHull hull = coaster(kStill, time > 7100.0 ? kSpeed : 0.0);
    map.advance(time, kStill, {-0.01, 0.0}, {&hull, 1}, {});
  }
  const Eigen::Vector2d here = map.at({-17.0, 0.0}, 7196.0);
  EXPECT_GT(here.x(), 0.3);
  EXPECT_LE(here.maxCoeff(), 1.2);
}

TEST(FoamMap, TellsWhatHasChanged) {
  FoamMap map;
  const MovingHull hull = coaster(kStill, 0.0);
  map.advance(10.0, kStill, kStill, {&hull, 1}, {});
  for (std::size_t level = 0; level < kFoamLevels; ++level) (void)map.take_changed(level);
  map.advance(11.0, kStill, kStill, {&hull, 1}, {});
  EXPECT_TRUE(map.take_changed(0).empty()) << "a hull at rest costs nothing";
  const MovingHull moves = coaster({1.0, 0.0}, kSpeed);
  map.advance(11.3, kStill, kStill, {&moves, 1}, {});
  const FoamLevel::Area area = map.take_changed(0);
  ASSERT_FALSE(area.empty());
  EXPECT_LT(area.high[0] - area.low[0], 120);
  EXPECT_TRUE(map.take_changed(0).empty());
}

TEST(FoamMap, IsBoundedForFleetsAndHugeHulls) {
  std::vector<MovingHull> fleet;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    fleet.push_back(coaster({3.0 * i, 1.0 * i}, 30.0));
    fleet.back().body = i;
    fleet.back().half_length = i % 2 == 0 ? 1e6 : 150.0;
    fleet.back().half_beam = i % 2 == 0 ? 1e6 : 25.0;
    fleet.back().way = Eigen::Vector2d(1.0, 0.1 * i).normalized();
  }
  const auto start = std::chrono::steady_clock::now();
  FoamMap map;
  for (double time = 0.0; time < 1.0; time += 0.1) map.advance(time, kStill, kStill, fleet, {});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << "without a bound it takes minutes";
  EXPECT_TRUE(map.present());
}

}  // namespace
}  // namespace pelagos
