// Bodies in a current that the particles do not make: the force alone, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/body_drift.hpp"

namespace pelagos {
namespace {

constexpr double kMass = 1000.0, kWeight = 9810.0, kStep = 0.01;

DriftSea walled_sea(const Eigen::Vector2d& current) {
  DriftSea sea;
  sea.current = current;
  sea.acts = {true, true};
  return sea;
}

/// A body whose particles resist by `drag(v)` (N), for some seconds; its velocity then.
template <class Drag>
Eigen::Vector2d drift(const DriftSea& sea, Eigen::Vector2d velocity, double seconds, double lift, Drag&& drag) {
  BodyDrift drift;
  for (int step = 0; step < static_cast<int>(std::lround(seconds / kStep)); ++step) {
    const Eigen::Vector2d push = drag(velocity);
    const DriftForce force = drift.act(sea, {kMass, kWeight, velocity, {push.x(), push.y(), lift}}, kStep);
    velocity += kStep / kMass * (push + force.on_body);
  }
  return velocity;
}

Eigen::Vector2d bluff(const Eigen::Vector2d& v) { return -800.0 * v.norm() * v; }
Eigen::Vector2d none(const Eigen::Vector2d&) { return Eigen::Vector2d::Zero(); }

TEST(BodyDrift, EndsAtTheCurrentWhateverTheDrag) {
  for (const Eigen::Vector2d& current : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(-0.3, 0.4)}) {
    const DriftSea sea = walled_sea(current);
    EXPECT_LT((drift(sea, {0, 0}, 40.0, kWeight, bluff) - current).norm(), 0.01 * current.norm());
    EXPECT_LT((drift(sea, {0, 0}, 40.0, kWeight, none) - current).norm(), 0.01 * current.norm());
    // One that has the current's speed keeps it all the time.
    for (const double seconds : {0.1, 2.0, 10.0})
      EXPECT_LT((drift(sea, current, seconds, kWeight, bluff) - current).norm(), 0.01 * current.norm());
  }
}

TEST(BodyDrift, ComesToTheCurrentWithinAQuarterOfTheRelaxation) {
  DriftSea sea = walled_sea({1.0, 0.0});
  sea.relaxation = 4.0;
  EXPECT_NEAR(drift(sea, {0, 0}, 1.0, kWeight, none).x(), 1.0 - std::exp(-1.0), 0.005);
  EXPECT_NEAR(drift(sea, {0, 0}, 1.0, 0.5 * kWeight, none).x(), 1.0 - std::exp(-0.5), 0.005) << "half of it is carried";
}

TEST(BodyDrift, LeavesABodyInTheAirAlone) {
  EXPECT_EQ(drift(walled_sea({2.0, 1.0}), {0.0, 0.3}, 5.0, 0.0, none), Eigen::Vector2d(0.0, 0.3));
}

TEST(BodyDrift, GoesWithTheSurfaceThatTheWindDragsAlong) {
  DriftSea sea = walled_sea({0.5, 0.0});
  sea.water = {0.2, 0.1};
  EXPECT_LT((drift(sea, {0, 0}, 40.0, kWeight, none) - Eigen::Vector2d(0.7, 0.1)).norm(), 0.01);
}

TEST(BodyDrift, KeepsOffAxesAlongWhichTheWaterFlows) {
  DriftSea sea = walled_sea({1.0, 1.0});
  sea.acts = {false, true};
  BodyDrift drift;
  const DriftForce force = drift.act(sea, {kMass, kWeight, {0, 0}, {-500.0, -500.0, kWeight}}, kStep);
  EXPECT_EQ(force.on_body.x(), 0.0);
  EXPECT_EQ(force.on_water.x(), 0.0);
  EXPECT_GT(force.on_body.y(), 500.0);
}

TEST(BodyDrift, TakesTheDragOfStillParticlesFromBodyAndWaterAlike) {
  // At the current's speed nothing pulls: what the body gets the water loses, so the particles' momentum stays.
  BodyDrift drift;
  const DriftForce force = drift.act(walled_sea({1.0, 0.0}), {kMass, kWeight, {1, 0}, {-700.0, 0.0, kWeight}}, kStep);
  EXPECT_DOUBLE_EQ(force.on_body.x(), 700.0);
  EXPECT_DOUBLE_EQ(force.on_water.x(), -700.0);
}

TEST(BodyDrift, LetsWavesMoveTheBody) {
  // A push to and fro, of 4 s, once the mean is known: amplitude F / (m w) without a current. With it the mean's filter
  // takes 1 / (1 + (w T / 2)^2) of the push and the pull damps by 4 / (w T): 10 % less remains than 1 of the amplitude.
  const double period = 4.0, omega = 2.0 * M_PI / period, amplitude = 600.0;
  const DriftSea sea = walled_sea({1.0, 0.0});
  BodyDrift drift;
  double velocity = 1.0, least = 10.0, most = -10.0;
  for (int step = 0; step < 10000; ++step) {
    const double push = amplitude * std::sin(omega * step * kStep);
    velocity +=
        kStep / kMass * (push + drift.act(sea, {kMass, kWeight, {velocity, 0}, {push, 0, kWeight}}, kStep).on_body.x());
    if (step * kStep < 90.0) continue;
    least = std::min(least, velocity);
    most = std::max(most, velocity);
  }
  EXPECT_NEAR(0.5 * (least + most), 1.0, 0.01);
  EXPECT_NEAR(0.5 * (most - least) / (amplitude / kMass / omega), 0.87, 0.03);
}

TEST(BodyDrift, FadesWithTheCurrent) {
  BodyDrift weak, strong;
  const DriftingHull hull{kMass, kWeight, {0, 0}, {-100.0, 0, kWeight}};
  EXPECT_EQ(weak.act(walled_sea({0.0, 0.0}), hull, kStep).on_body, Eigen::Vector2d::Zero());
  EXPECT_NEAR(strong.act(walled_sea({0.05, 0.0}), hull, kStep).on_body.x(), 0.5 * (100.0 + kMass * 0.04), 1e-9);
}

}  // namespace
}  // namespace pelagos
