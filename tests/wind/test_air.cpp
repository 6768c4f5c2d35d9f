#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "wind/air.hpp"

namespace pelagos {
namespace {

const AirSurroundings kSurroundings{.frame = {}, .water_level = 0.5, .seed = 4};
constexpr double kMast = 10.5;  // m, world: 10 m above the mean level, where the wind is as set

WindSettings paper_wind() {
  WindSettings wind;
  wind.velocity = {-18, -0.5, 0};
  wind.amplitude = 3;
  wind.length = 1;
  wind.beta = 1.5;
  return wind;
}

TEST(Air, DisturbanceIsCarriedByTheMeanWind) {
  const WindSettings wind = paper_wind();
  const Air air(kSurroundings, wind);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d place(0.3 * i, 1.0, kMast);
    const double time = 0.17 * i;
    EXPECT_LT((air.velocity_at(place, 0) - air.velocity_at(place + wind.velocity * time, time)).norm(), 1e-9);
  }
}

TEST(Air, DisturbanceHasTheNoisesStrength) {
  const Air air(kSurroundings, paper_wind());
  double squares = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i)
    squares += (air.velocity_at({0.613 * i, 0.291 * i, kMast}, 0) - paper_wind().velocity).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / (3 * count)), 0.272 * 3, 0.02 * 3);  // neighbouring samples are not independent
}

TEST(Air, RampIsLinearAndContinuous) {
  WindSettings calm = paper_wind(), storm = paper_wind();
  calm.velocity = {4, 0, 0};
  calm.amplitude = 1;
  storm.velocity = {0, 20, 0};
  storm.amplitude = 5;
  storm.length = 3;
  Air air(kSurroundings, calm);
  air.set(storm, 10.0, 8.0);
  EXPECT_LT((air.settings_at(14.0).velocity - Eigen::Vector3d(2, 10, 0)).norm(), 1e-12);
  EXPECT_NEAR(air.settings_at(14.0).amplitude, 3.0, 1e-12);
  EXPECT_NEAR(air.settings_at(12.0).length, 1.5, 1e-12);
  EXPECT_LT((air.settings_at(30.0).velocity - storm.velocity).norm(), 1e-12);

  // Steps of 1 ms never change the wind by more than its steepest slope allows (amplitude 5, slope 3, 20 eddies a
  // second: 0.3 m/s), also across a replaced ramp. A jump of the noise's argument would give several m/s.
  const Eigen::Vector3d place(37.0, -12.0, kMast);
  Eigen::Vector3d before = air.velocity_at(place, 9.999);
  for (int i = 0; i < 12000; ++i) {
    const double time = 10.0 + 0.001 * i;
    if (i == 5000) air.set(calm, time, 3.0);
    const Eigen::Vector3d now = air.velocity_at(place, time);
    ASSERT_LT((now - before).norm(), 0.35) << time;
    before = now;
  }
}

TEST(Air, CarriedWayIsTheIntegralOfTheMeanWind) {
  // With the length constant, the disturbance at time t equals that at time 0 displaced by the integral of U.
  WindSettings slow = paper_wind(), fast = paper_wind();
  slow.velocity = {2, 0, 0};
  fast.velocity = {10, 4, 0};
  Air air(kSurroundings, slow);
  const Eigen::Vector3d place(1, 2, kMast);
  const Eigen::Vector3d start = air.velocity_at(place, 0.0) - slow.velocity;
  air.set(fast, 1.0, 4.0);
  const Eigen::Vector3d way = Eigen::Vector3d(2, 0, 0) * 1 + Eigen::Vector3d(6, 2, 0) * 4 + fast.velocity * 2;
  EXPECT_LT((air.velocity_at(place + way, 7.0) - fast.velocity - start).norm(), 1e-9);
}

TEST(Air, PulseOpensAndClosesInSeconds) {
  WindSettings wind = paper_wind();
  wind.pulse = WindPulse{.period = 4, .width = 1.5};
  const Air air(kSurroundings, wind);
  EXPECT_GT(air.velocity_at({1, 1, kMast}, 0.0).norm(), 1.0);
  EXPECT_GT(air.velocity_at({1, 1, kMast}, 1.49).norm(), 1.0);
  EXPECT_EQ(air.velocity_at({1, 1, kMast}, 1.51).norm(), 0.0);
  EXPECT_EQ(air.velocity_at({1, 1, kMast}, 3.99).norm(), 0.0);
  EXPECT_GT(air.velocity_at({1, 1, kMast}, 4.01).norm(), 1.0);
}

TEST(Air, SeedChangesTheDisturbanceOnly) {
  AirSurroundings other = kSurroundings;
  other.seed = 5;
  const Air a(kSurroundings, paper_wind()), b(kSurroundings, paper_wind()), c(other, paper_wind());
  EXPECT_EQ(a.velocity_at({1.3, 2.2, kMast}, 3), b.velocity_at({1.3, 2.2, kMast}, 3));
  EXPECT_NE(a.velocity_at({1.3, 2.2, kMast}, 3), c.velocity_at({1.3, 2.2, kMast}, 3));
}

TEST(Air, FollowsTheLogProfileAboveTheMeanLevel) {
  WindSettings wind = paper_wind();
  wind.roughness = 1e-3;
  const Air air(kSurroundings, wind);
  const Eigen::Vector3d reference = air.velocity_at({3, 4, kMast}, 2.0);
  EXPECT_LT((air.velocity_at({3, 4, 0.5 + 31.6227766}, 2.0) - 1.125 * reference).norm(),
            1e-8);                                                                // ln(10^4.5) / ln(10^4)
  EXPECT_LT((air.velocity_at({3, 4, 0.6}, 2.0) - 0.5 * reference).norm(), 1e-9);  // ln(100) / ln(10^4)
  EXPECT_EQ(air.velocity_at({3, 4, 0.5009}, 2.0).norm(), 0.0) << "within the roughness";
  EXPECT_EQ(air.velocity_at({3, 4, 0.2}, 2.0).norm(), 0.0) << "under it, never negative";
}

TEST(Air, AnAnemometerAtTenMetresReadsWhatPushesTheSea) {
  AirSurroundings around = kSurroundings;
  around.frame.origin = {100, -50, -3};
  const Air air(around, paper_wind());
  const Eigen::Vector3d local(7.3, 2.1, air.local_level());
  EXPECT_EQ(air.velocity_at({107.3, -47.9, kMast}, 3.0), air.reference(air.at(3.0), local));
}

TEST(Air, GustsFallOffBeyondTheFrequencyAtWhichEddiesPass) {
  // Perlin's noise holds one octave: hardly anything beyond twice the frequency U / l of one eddy a length. A noise
  // that is new at every sample would be flat and leave 87 % there.
  WindSettings wind = paper_wind();
  wind.velocity = {10, 0, 0};
  wind.length = 20;  // 0.5 Hz
  const Air air(kSurroundings, wind);
  constexpr int kCount = 1024;
  constexpr double kRate = 16.0;  // Hz
  double low = 0.0, high = 0.0;
  std::vector<double> sample(kCount);
  for (int n = 0; n < kCount; ++n)
    sample[static_cast<std::size_t>(n)] = air.velocity_at({0, 0, kMast}, n / kRate).x() - 10.0;
  for (int k = 1; k < kCount / 2; ++k) {
    double re = 0.0, im = 0.0;
    for (int n = 0; n < kCount; ++n) {
      const double hann = 0.5 - 0.5 * std::cos(2.0 * M_PI * n / kCount), angle = 2.0 * M_PI * k * n / kCount;
      re += hann * sample[static_cast<std::size_t>(n)] * std::cos(angle);
      im -= hann * sample[static_cast<std::size_t>(n)] * std::sin(angle);
    }
    (k * kRate / kCount < 1.0 ? low : high) += re * re + im * im;
  }
  EXPECT_LT(high / (low + high), 0.1);
}

TEST(Air, MeanIsTheWindThatWasSet) {
  const Air air(kSurroundings, paper_wind());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  constexpr int kCount = 20000;
  for (int n = 0; n < kCount; ++n) sum += air.velocity_at({0.613 * n, 0.291 * n, kMast}, 0.0);
  // 0.27 A / sqrt(count) is 0.006; neighbouring samples are not independent, and columns of the table repeat
  EXPECT_LT((sum / kCount - paper_wind().velocity).norm(), 0.05);
}

}  // namespace
}  // namespace pelagos
