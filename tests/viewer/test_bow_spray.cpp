#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/bow_spray.hpp"

namespace pelagos {
namespace {

const Eigen::Vector2d kNoWind = Eigen::Vector2d::Zero();

MovingHull hull_at(double x, double speed, double slam) {
  MovingHull hull;
  hull.body = 1;
  hull.place = {x, 0.0};
  hull.half_length = 18.0;
  hull.half_beam = 4.5;
  hull.speed = speed;
  hull.slam = slam;
  return hull;
}

std::vector<SprayCluster> spray_of(double speed, double slam, double step = 0.05) {
  BowSpray spray;
  for (double time = 0.0; time < 4.0 + 1e-9; time += step) {
    const MovingHull hull = hull_at(speed * time, speed, slam);
    spray.advance(time, {&hull, 1});
  }
  const MovingHull hull = hull_at(speed * 4.0, speed, slam);
  spray.advance(4.0, {&hull, 1});
  return spray.clusters(4.0, 0.0, kNoWind);
}

double highest(const std::vector<SprayCluster>& clusters) {
  double top = 0.0;
  for (const SprayCluster& cluster : clusters) top = std::max(top, cluster.place.z());
  return top;
}

TEST(BowSpray, TellsSpeedAndSlam) {
  EXPECT_TRUE(spray_of(0.0, 0.0).empty());
  EXPECT_TRUE(spray_of(2.0, 0.0).empty()) << "slow in calm water";
  const auto steady = spray_of(7.2, 0.0), slams = spray_of(7.2, 4.0), drifts = spray_of(0.0, 4.0);
  EXPECT_FALSE(steady.empty());
  EXPECT_GT(slams.size(), 2 * steady.size());
  EXPECT_GT(highest(slams), highest(steady) + 1.0);
  EXPECT_LT(drifts.size(), slams.size()) << "without way the water is pressed aside";
  EXPECT_EQ(bow_force(7.2, -5.0), bow_force(7.2, 0.0)) << "a bow that leaves the water throws nothing more";
  EXPECT_LE(bow_force(50.0, 100.0), 1.0);
}

TEST(BowSpray, LiesAboutTheForwardPartOfTheHull) {
  const double bow = 7.2 * 4.0 + 18.0;
  int port = 0, starboard = 0;
  for (const SprayCluster& cluster : spray_of(7.2, 4.0)) {
    EXPECT_LT(cluster.place.x(), bow + 3.0);
    EXPECT_GT(cluster.place.x(), bow - 40.0);
    EXPECT_LT(std::abs(cluster.place.y()), 25.0);
    EXPECT_GT(cluster.place.z(), -0.5);
    EXPECT_GT(cluster.size, 0.0);
    (cluster.place.y() > 0.0 ? port : starboard) += 1;
  }
  EXPECT_NEAR(port, starboard, 0.2 * port);
}

TEST(BowSpray, IsTheSameWhereverTheInstantsLie) {
  const auto one = spray_of(7.2, 3.0, 1.0 / 60.0), other = spray_of(7.2, 3.0, 0.13);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_LT((one[i].place - other[i].place).norm(), 0.01);
}

TEST(BowSpray, LateViewersAndJumpsAssumeASteadyWay) {
  BowSpray late;
  const MovingHull hull = hull_at(0.0, 7.2, 0.0);
  late.advance(50.0, {&hull, 1});
  EXPECT_NEAR(static_cast<double>(late.clusters(50.0, 0.0, kNoWind).size()),
              static_cast<double>(spray_of(7.2, 0.0).size()), 12.0);
  late.advance(20.0, {});
  EXPECT_TRUE(late.clusters(20.0, 0.0, kNoWind).empty());
}

TEST(BowSpray, IsBoundedForAFleet) {
  std::vector<MovingHull> fleet;
  for (std::uint32_t i = 0; i < 200; ++i) {
    fleet.push_back(hull_at(0.0, 30.0, 50.0));
    fleet.back().body = i;
  }
  BowSpray spray;
  spray.advance(10.0, fleet);
  EXPECT_LE(spray.clusters(10.0, 0.0, kNoWind).size(), BowSpray::kMost);
}

TEST(BowSpray, TheWindCarriesIt) {
  BowSpray spray;
  const MovingHull hull = hull_at(0.0, 7.2, 4.0);
  spray.advance(10.0, {&hull, 1});
  const auto mean = [&](const Eigen::Vector2d& wind) {
    double sum = 0.0;
    const auto clusters = spray.clusters(10.0, 0.0, wind);
    for (const SprayCluster& cluster : clusters) sum += cluster.place.y() / static_cast<double>(clusters.size());
    return sum;
  };
  EXPECT_GT(mean({0.0, 15.0}), mean({0.0, -15.0}) + 0.3);
}

}  // namespace
}  // namespace pelagos
