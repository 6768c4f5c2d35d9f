#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "wind/gust_wind.hpp"

namespace pelagos {
namespace {

constexpr double kSpacing = 0.05;
const GustSite kSite{.spacing = kSpacing, .gravity = 9.81, .rest_density = 1000, .water_level = 0.475, .seed = 4};

WindSettings paper_wind() {
  WindSettings wind;
  wind.velocity = {-18, -0.5, 0};
  wind.amplitude = 3;
  wind.length = 1;
  wind.beta = 1.5;
  return wind;
}

/// A block of particles at d, 2d, ...
std::vector<Float4> make_block(int nx, int ny, int nz, float d = static_cast<float>(kSpacing)) {
  std::vector<Float4> position;
  for (int i = 1; i <= nx; ++i)
    for (int j = 1; j <= ny; ++j)
      for (int k = 1; k <= nz; ++k)
        position.push_back({static_cast<float>(i) * d, static_cast<float>(j) * d, static_cast<float>(k) * d, 0});
  return position;
}

std::vector<Float4> push_on(GustWind& wind, const std::vector<Float4>& position, double time, int threads = 1) {
  TaskPool pool(threads);
  std::vector<Float4> acceleration(position.size());
  wind.add_acceleration(pool, position, position.size(), time, acceleration);
  return acceleration;
}

TEST(GustWind, MeanPushEqualsThePapersOverItsOwnWindScene) {
  WindSettings wind = paper_wind();
  wind.amplitude = 0;  // the mean of the disturbance is zero
  GustWind gust(kSite, wind);
  const auto position = make_block(99, 39, 9);  // 34,749 particles
  ASSERT_EQ(position.size(), 34749u);
  const auto acceleration = push_on(gust, position, 0.0);
  Eigen::Vector3d ours = Eigen::Vector3d::Zero(), paper = Eigen::Vector3d::Zero();
  const double step = 0.07 * std::sqrt(kSpacing / 9.81);
  for (std::size_t n = 0; n < position.size(); ++n) {
    ours += Eigen::Vector3f(acceleration[n].x, acceleration[n].y, acceleration[n].z).cast<double>();
    const double z = static_cast<double>(position[n].z);
    paper += 1.5 * 1.293 / 1000.0 * wind.velocity / std::log(10.0 / 0.01) * std::log(z / 0.01) / step;
  }
  EXPECT_LT((ours - paper).norm(), 1e-3 * paper.norm());  // the decay depth is rounded to four digits
}

TEST(GustWind, FallsFromTheLawsFullValueAtTheSurface) {
  WindSettings wind = paper_wind();
  wind.amplitude = 0;
  GustWind gust(kSite, wind);
  const auto position = make_block(20, 20, 60);
  const auto acceleration = push_on(gust, position, 0.0);
  const double full = 1.5 * 1.293 / 1000 * -18 / (0.07 * std::sqrt(kSpacing / 9.81));
  for (std::size_t n = 0; n < 60; ++n) {
    const double depth = (59.5 - static_cast<double>(n)) * kSpacing;
    const double expected = full * std::exp(-depth / (GustWind::kDecaySpacings * kSpacing));
    EXPECT_NEAR(static_cast<double>(acceleration[n].x), expected, 1.1e-3 * std::abs(full));  // cut off below 1e-3
  }
  EXPECT_EQ(acceleration[0].x, 0.0f);  // 60 layers down
}

TEST(GustWind, DoesNotDependOnTheTimeStepButOnTime) {
  GustWind gust(kSite, paper_wind());
  const auto position = make_block(30, 10, 5);
  const auto first = push_on(gust, position, 0.5);
  static_cast<void>(push_on(gust, position, 0.25));
  const auto again = push_on(gust, position, 0.5);
  const auto later = push_on(gust, position, 0.6);
  EXPECT_EQ(first[7].x, again[7].x);
  EXPECT_NE(first[7].x, later[7].x);
}

TEST(GustWind, SameBitsForAnyNumberOfThreads) {
  GustWind gust(kSite, paper_wind());
  const auto position = make_block(60, 39, 9);
  const auto one = push_on(gust, position, 1.0, 1);
  for (const int threads : {2, 7}) {
    const auto many = push_on(gust, position, 1.0, threads);
    for (std::size_t n = 0; n < one.size(); ++n) {
      ASSERT_EQ(one[n].x, many[n].x) << n;
      ASSERT_EQ(one[n].y, many[n].y) << n;
      ASSERT_EQ(one[n].z, many[n].z) << n;
    }
  }
}

TEST(GustWind, DisturbanceIsCarriedByTheMeanWind) {
  const WindSettings wind = paper_wind();
  const GustWind gust(kSite, wind);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d place(0.3 * i, 1.0, 0.5);
    const double time = 0.17 * i;
    EXPECT_LT((gust.velocity_at(place, 0) - gust.velocity_at(place + wind.velocity * time, time)).norm(), 1e-9);
  }
}

TEST(GustWind, DisturbanceHasTheNoisesStrength) {
  const GustWind gust(kSite, paper_wind());
  double squares = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i)
    squares += (gust.velocity_at({0.613 * i, 0.291 * i, 0.177 * i}, 0) - paper_wind().velocity).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / (3 * count)), 0.272 * 3, 0.02 * 3);  // neighbouring samples are not independent
}

TEST(GustWind, GridReproducesTheDisturbanceWithinTwoPercent) {
  WindSettings wind = paper_wind();
  wind.length = 10 * kSpacing;
  wind.amplitude = 18;
  GustWind gust(kSite, wind);
  const auto position = make_block(99, 39, 9);
  const auto acceleration = push_on(gust, position, 0.3);
  const double scale = 1.5 * 1.293 / 1000 / (0.07 * std::sqrt(kSpacing / 9.81));
  double error = 0.0;
  int count = 0;
  for (std::size_t n = 8; n < position.size(); n += 9) {  // the top layer
    const Eigen::Vector3d place(static_cast<double>(position[n].x), static_cast<double>(position[n].y), 0.475);
    if (place.x() < 0.1 || place.x() > 4.9 || place.y() < 0.1 || place.y() > 1.9) continue;  // no centres beyond
    const Eigen::Vector3d air = gust.velocity_at(place, 0.3);
    const double f = std::exp(-0.5 / GustWind::kDecaySpacings);
    error += std::pow(static_cast<double>(acceleration[n].x) / (scale * f) - air.x(), 2);
    ++count;
  }
  // linear interpolation over 0.2 eddy lengths: what the header states, as part of the amplitude
  EXPECT_LT(std::sqrt(error / count) / wind.amplitude, 0.02);
}

TEST(GustWind, RampIsLinearAndContinuous) {
  WindSettings calm = paper_wind(), storm = paper_wind();
  calm.velocity = {4, 0, 0};
  calm.amplitude = 1;
  storm.velocity = {0, 20, 0};
  storm.amplitude = 5;
  storm.length = 3;
  GustWind gust(kSite, calm);
  gust.set(storm, 10.0, 8.0);
  EXPECT_LT((gust.settings_at(14.0).velocity - Eigen::Vector3d(2, 10, 0)).norm(), 1e-12);
  EXPECT_NEAR(gust.settings_at(14.0).amplitude, 3.0, 1e-12);
  EXPECT_NEAR(gust.settings_at(12.0).length, 1.5, 1e-12);
  EXPECT_LT((gust.settings_at(30.0).velocity - storm.velocity).norm(), 1e-12);

  // Steps of 1 ms never change the wind by more than its steepest slope allows (amplitude 5, slope 3, 20 eddies a
  // second: 0.3 m/s), also across a replaced ramp. A jump of the noise's argument would give several m/s.
  const Eigen::Vector3d place(37.0, -12.0, 0.5);
  Eigen::Vector3d before = gust.velocity_at(place, 9.999);
  for (int i = 0; i < 12000; ++i) {
    const double time = 10.0 + 0.001 * i;
    if (i == 5000) gust.set(calm, time, 3.0);
    const Eigen::Vector3d now = gust.velocity_at(place, time);
    ASSERT_LT((now - before).norm(), 0.35) << time;
    before = now;
  }
}

TEST(GustWind, CarriedWayIsTheIntegralOfTheMeanWind) {
  // With the length constant, the disturbance at time t equals that at time 0 displaced by the integral of U.
  WindSettings slow = paper_wind(), fast = paper_wind();
  slow.velocity = {2, 0, 0};
  fast.velocity = {10, 4, 0};
  GustWind gust(kSite, slow);
  const Eigen::Vector3d place(1, 2, 0.5);
  const Eigen::Vector3d start = gust.velocity_at(place, 0.0) - slow.velocity;
  gust.set(fast, 1.0, 4.0);
  const Eigen::Vector3d way = Eigen::Vector3d(2, 0, 0) * 1 + Eigen::Vector3d(6, 2, 0) * 4 + fast.velocity * 2;
  EXPECT_LT((gust.velocity_at(place + way, 7.0) - fast.velocity - start).norm(), 1e-9);
}

TEST(GustWind, PulseOpensAndClosesInSeconds) {
  WindSettings wind = paper_wind();
  wind.pulse = WindPulse{.period = 4, .width = 1.5};
  const GustWind gust(kSite, wind);
  EXPECT_GT(gust.velocity_at({1, 1, 1}, 0.0).norm(), 1.0);
  EXPECT_GT(gust.velocity_at({1, 1, 1}, 1.49).norm(), 1.0);
  EXPECT_EQ(gust.velocity_at({1, 1, 1}, 1.51).norm(), 0.0);
  EXPECT_EQ(gust.velocity_at({1, 1, 1}, 3.99).norm(), 0.0);
  EXPECT_GT(gust.velocity_at({1, 1, 1}, 4.01).norm(), 1.0);
}

TEST(GustWind, SeedChangesTheDisturbanceOnly) {
  GustSite other = kSite;
  other.seed = 5;
  const GustWind a(kSite, paper_wind()), b(kSite, paper_wind()), c(other, paper_wind());
  EXPECT_EQ(a.velocity_at({1.3, 2.2, 0.4}, 3), b.velocity_at({1.3, 2.2, 0.4}, 3));
  EXPECT_NE(a.velocity_at({1.3, 2.2, 0.4}, 3), c.velocity_at({1.3, 2.2, 0.4}, 3));
}

TEST(GustWind, AFlyingDropDoesNotShadowTheWater) {
  WindSettings wind = paper_wind();
  wind.amplitude = 0;
  GustWind gust(kSite, wind);
  auto position = make_block(20, 20, 9);
  const auto without = push_on(gust, position, 0.0);
  position.push_back({0.5f, 0.5f, 3.0f, 0});
  const auto with = push_on(gust, position, 0.0);
  for (std::size_t n = 0; n < without.size(); ++n)
    EXPECT_GT(with[n].x / without[n].x, 0.64);  // at most 2 d deeper: exp(-2 / 4.614) = 0.648
  EXPECT_NEAR(static_cast<double>(with.back().x), 1.5 * 1.293e-3 * -18 / (0.07 * std::sqrt(kSpacing / 9.81)), 1e-4);
}

TEST(GustWind, SurvivesAbsurdInput) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  GustWind gust(kSite, paper_wind());
  auto position = make_block(5, 5, 5);
  position[3].x = nan;
  position[10].z = infinity;
  position[20].y = 3e38f;
  position[21].y = -3e38f;
  const auto acceleration = push_on(gust, position, 1e5);
  EXPECT_EQ(acceleration[3].x, 0.0f);
  EXPECT_EQ(acceleration[10].x, 0.0f);
  for (const Float4& a : acceleration) EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z));
  EXPECT_TRUE(push_on(gust, {}, 0).empty());

  GustSite weightless = kSite;
  weightless.gravity = 0;
  GustWind none(weightless, paper_wind());
  EXPECT_EQ(push_on(none, make_block(3, 3, 3), 0)[0].x, 0.0f);
}

}  // namespace
}  // namespace pelagos
