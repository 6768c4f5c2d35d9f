#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "surface/water_columns.hpp"
#include "wind/drag.hpp"
#include "wind/wind.hpp"

namespace pelagos {
namespace {

constexpr double kSpacing = 0.05;
constexpr double kStep = 0.0049975;  // s, 0.07 sqrt(d / g)

WindSurroundings surroundings_of(double gravity = 9.81) {
  return {{PatchFrame{}, 0.475, 4}, kSpacing, gravity, 1000.0};
}

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

struct Push {
  std::vector<Float4> acceleration, velocity;
};
Push act(Wind& wind, const std::vector<Float4>& position, double time, int threads = 1) {
  TaskPool pool(threads);
  Push push{std::vector<Float4>(position.size()), std::vector<Float4>(position.size())};
  const WaterColumns columns(pool, {position, position, position.size(), 0, 0, kSpacing});
  SurfaceGrid surface;
  columns.sample(pool, surface);
  wind.act(pool, &surface, position, position.size(), time, push.acceleration, push.velocity);
  return push;
}
std::vector<Float4> push_on(Wind& wind, const std::vector<Float4>& position, double time, int threads = 1) {
  return act(wind, position, time, threads).acceleration;
}

TEST(GustLaw, MeanPushEqualsThePapersOverItsOwnWindScene) {
  WindSettings wind = paper_wind();
  wind.amplitude = 0;  // the mean of the disturbance is zero
  Wind gust(surroundings_of(), wind);
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

TEST(GustLaw, FallsFromTheLawsFullValueAtTheSurface) {
  WindSettings wind = paper_wind();
  wind.amplitude = 0;
  Wind gust(surroundings_of(), wind);
  const auto position = make_block(20, 20, 60);
  const auto acceleration = push_on(gust, position, 0.0);
  const double full = 1.5 * 1.293 / 1000 * -18 / (0.07 * std::sqrt(kSpacing / 9.81));
  for (std::size_t n = 0; n < 60; ++n) {
    const double depth = (59.5 - static_cast<double>(n)) * kSpacing;
    const double expected = full * std::exp(-depth / (Wind::kDecaySpacings * kSpacing));
    EXPECT_NEAR(static_cast<double>(acceleration[n].x), expected, 1.1e-3 * std::abs(full));  // cut off below 1e-3
  }
  EXPECT_EQ(acceleration[0].x, 0.0f);  // 60 layers down
}

TEST(GustLaw, DoesNotDependOnTheTimeStepButOnTime) {
  Wind gust(surroundings_of(), paper_wind());
  const auto position = make_block(30, 10, 5);
  const auto first = push_on(gust, position, 0.5);
  static_cast<void>(push_on(gust, position, 0.25));
  const auto again = push_on(gust, position, 0.5);
  const auto later = push_on(gust, position, 0.6);
  EXPECT_EQ(first[7].x, again[7].x);
  EXPECT_NE(first[7].x, later[7].x);
}

TEST(GustLaw, SameBitsForAnyNumberOfThreads) {
  Wind gust(surroundings_of(), paper_wind());
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

TEST(GustLaw, GridReproducesTheDisturbanceWithinTwoPercent) {
  WindSettings wind = paper_wind();
  wind.length = 10 * kSpacing;
  wind.amplitude = 18;
  Wind gust(surroundings_of(), wind);
  const auto position = make_block(99, 39, 9);
  const auto acceleration = push_on(gust, position, 0.3);
  const double scale = 1.5 * 1.293 / 1000 / (0.07 * std::sqrt(kSpacing / 9.81));
  double error = 0.0;
  int count = 0;
  for (std::size_t n = 8; n < position.size(); n += 9) {  // the top layer
    const Eigen::Vector3d place(static_cast<double>(position[n].x), static_cast<double>(position[n].y), 0.475);
    if (place.x() < 0.1 || place.x() > 4.9 || place.y() < 0.1 || place.y() > 1.9) continue;  // no centres beyond
    const Eigen::Vector3d air = gust.air().velocity_at(place + Eigen::Vector3d(0, 0, 10), 0.3);
    const double f = std::exp(-0.5 / Wind::kDecaySpacings);
    error += std::pow(static_cast<double>(acceleration[n].x) / (scale * f) - air.x(), 2);
    ++count;
  }
  // linear interpolation over 0.2 eddy lengths: what the header states, as part of the amplitude
  EXPECT_LT(std::sqrt(error / count) / wind.amplitude, 0.02);
}

TEST(GustLaw, AFlyingDropDoesNotShadowTheWater) {
  WindSettings wind = paper_wind();
  wind.amplitude = 0;
  Wind gust(surroundings_of(), wind);
  auto position = make_block(20, 20, 9);
  const auto without = push_on(gust, position, 0.0);
  position.push_back({0.5f, 0.5f, 3.0f, 0});
  const auto with = push_on(gust, position, 0.0);
  for (std::size_t n = 0; n < without.size(); ++n)
    EXPECT_GT(with[n].x / without[n].x, 0.64);  // at most 2 d deeper: exp(-2 / 4.614) = 0.648
  EXPECT_NEAR(static_cast<double>(with.back().x), 1.5 * 1.293e-3 * -18 / (0.07 * std::sqrt(kSpacing / 9.81)), 1e-4);
}

TEST(GustLaw, SurvivesAbsurdInput) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  Wind gust(surroundings_of(), paper_wind());
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

  Wind none(surroundings_of(0.0), paper_wind());
  EXPECT_EQ(push_on(none, make_block(3, 3, 3), 0)[0].x, 0.0f);
}

TEST(StressLaw, GivesTheSeaTheMomentumThatTheAirLoses) {
  WindSettings wind = paper_wind();
  wind.law = WindLaw::kStress;
  wind.amplitude = 0;
  Wind stress(surroundings_of(), wind);
  const auto position = make_block(20, 20, 30);
  const auto acceleration = push_on(stress, position, 0.0);
  double taken = 0.0;  // N per m^2, of one column
  for (std::size_t n = 0; n < 30; ++n) taken += static_cast<double>(acceleration[n].x) * 1000.0 * kSpacing;
  const double speed = wind.velocity.norm();
  const double stress_x = 1.293 * (0.49 + 0.065 * speed) * 1e-3 * speed * -18.0;
  EXPECT_NEAR(taken, stress_x, 1.5e-3 * std::abs(stress_x));  // cut off where f is below 1e-3
  EXPECT_EQ(acceleration[0].x, 0.0f) << "30 layers down";
}

TEST(StressLaw, DragFollowsLargeAndPond) {
  // Read from the tables of USGS' air_sea toolbox, which computes them so.
  for (const auto& [speed, drag] : {std::pair{4.0, 1.15}, {10.0, 1.15}, {12.0, 1.27}, {18.0, 1.66}, {25.0, 2.115}})
    EXPECT_NEAR(sea_drag_coefficient(speed), drag * 1e-3, 1e-9) << speed;
  EXPECT_EQ(sea_drag_coefficient(60.0), sea_drag_coefficient(33.0));
  EXPECT_EQ(sea_drag_coefficient(0.0), 1.15e-3);
}

TEST(StressLaw, IsFarWeakerThanTheLawGust) {
  WindSettings wind = paper_wind();
  Wind gust(surroundings_of(), wind);
  wind.law = WindLaw::kStress;
  Wind stress(surroundings_of(), wind);
  const auto position = make_block(20, 20, 9);
  EXPECT_LT(push_on(stress, position, 0.0)[8].x / push_on(gust, position, 0.0)[8].x, 0.1f);
}

TEST(PaperLaw, AddsAVelocityEveryStepAsPrinted) {
  WindSettings wind = paper_wind();
  wind.law = WindLaw::kPaper;
  wind.roughness = 0.01;
  wind.amplitude = 0;
  Wind paper(surroundings_of(), wind);
  const std::vector<Float4> position = {{1, 1, 0.05f, 0}, {1, 1, 0.45f, 0}, {1, 1, 0.005f, 0}, {1, 1, -0.1f, 0}};
  const Push push = act(paper, position, 0.0);
  const double unit = 1.5 * 1.293e-3 * -18.0 / std::log(10.0 / 0.01);
  EXPECT_NEAR(push.velocity[0].x, unit * std::log(0.05 / 0.01), 1e-7);
  EXPECT_NEAR(push.velocity[1].x, unit * std::log(0.45 / 0.01), 1e-7);
  EXPECT_NEAR(push.velocity[2].x, unit * std::log(0.5), 1e-7) << "against the wind below z0, as printed";
  EXPECT_EQ(push.velocity[3].x, 0.0f) << "under the floor";
  EXPECT_EQ(push.acceleration[0].x, 0.0f);
}

TEST(PaperLaw, PulseCountsStepsAndTheNoiseIsNewInEach) {
  WindSettings wind = paper_wind();
  wind.law = WindLaw::kPaper;
  wind.roughness = 0.01;
  wind.pulse = WindPulse{.period = 4, .width = 3};
  Wind paper(surroundings_of(), wind);
  const std::vector<Float4> position = {{1.3f, 1.7f, 0.45f, 0}};
  std::vector<float> pushes;
  for (int step = 0; step < 8; ++step) pushes.push_back(act(paper, position, 0.0).velocity[0].x);
  for (const int closed : {3, 7}) EXPECT_EQ(pushes[static_cast<std::size_t>(closed)], 0.0f) << closed;
  for (const int open : {0, 1, 2, 4, 5, 6}) EXPECT_LT(pushes[static_cast<std::size_t>(open)], 0.0f) << open;
  EXPECT_NE(pushes[0], pushes[1]);
  Wind again(surroundings_of(), wind);
  EXPECT_EQ(act(again, position, 0.7).velocity[0].x, pushes[0]) << "the same seed, the same noise";
}

TEST(PaperLaw, SurvivesAbsurdInput) {
  WindSettings wind = paper_wind();
  wind.law = WindLaw::kPaper;
  Wind paper(surroundings_of(), wind);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Push push = act(paper, {{nan, 0, 0.1f, 0}, {0, 0, std::numeric_limits<float>::infinity(), 0}}, 0.0);
  EXPECT_EQ(push.velocity[0].x, 0.0f);
  EXPECT_EQ(push.velocity[1].x, 0.0f);
}

TEST(Wind, ChangesItsLawWhileItBlows) {
  WindSettings wind = paper_wind();
  Wind blowing(surroundings_of(), wind);
  const std::vector<Float4> position = make_block(6, 6, 6);
  EXPECT_NE(act(blowing, position, 0.0).acceleration[5].x, 0.0f);
  wind.law = WindLaw::kPaper;
  blowing.set(wind, 0.1, 0.0);
  const Push push = act(blowing, position, 0.1);
  EXPECT_EQ(push.acceleration[5].x, 0.0f);
  EXPECT_NE(push.velocity[5].x, 0.0f);
}

}  // namespace
}  // namespace pelagos
