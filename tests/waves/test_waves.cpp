#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "../support/csv.hpp"
#include "../support/places.hpp"
#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"
#include "waves/wave_components.hpp"

namespace pelagos {
namespace {

const std::string kData = test::source_path("tests/waves/data/");

TEST(SplitMix64, ReproducesThePublishedSequence) {
  // First outputs for seed 1234567, as tabulated for the reference implementation (Vigna, splitmix64.c).
  SplitMix64 random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317u);
  EXPECT_EQ(random.next(), 3203168211198807973u);
  EXPECT_EQ(random.next(), 9817491932198370423u);
}

TEST(Beaufort, AgreesWithTheTable) {
  for (const auto& row : test::read_csv(kData + "beaufort.csv")) {
    const int number = std::stoi(row[0]);
    EXPECT_DOUBLE_EQ(significant_wave_height(number), std::stod(row[3]));
    EXPECT_EQ(beaufort_number(std::stod(row[1])), number);
    if (!row[2].empty()) {
      EXPECT_EQ(beaufort_number(std::stod(row[2])), number);
    }
  }
  EXPECT_EQ(beaufort_number(-3.0), 0);
  EXPECT_EQ(beaufort_number(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_DOUBLE_EQ(significant_wave_height(99), 14.0);
}

TEST(SeaState, HasTheSignificantHeightOfItsBeaufortNumber) {
  for (int number = 1; number <= 12; ++number)
    for (const std::uint32_t count : {1u, 7u, 24u, 100u}) {
      const auto waves = make_wave_components({.beaufort = number, .components = count, .seed = 5});
      ASSERT_EQ(waves.size(), count);
      // amplitudes are stored in single precision: relative error 6e-8 each
      EXPECT_NEAR(4.0 * std::sqrt(wave_variance(waves)), significant_wave_height(number),
                  1e-6 * significant_wave_height(number));
    }
}

TEST(SeaState, IsFlatAtBeaufortZeroAndWithoutComponents) {
  EXPECT_TRUE(make_wave_components({.beaufort = 0}).empty());
  EXPECT_TRUE(make_wave_components({.beaufort = 5, .components = 0}).empty());
  EXPECT_EQ(wave_elevation({}, 1, 2, 3), 0.0);
}

TEST(SeaState, PeakFollowsPiersonMoskowitz) {
  // Hs = 3.0 m: Tp = 5.00 sqrt(Hs) = 8.66 s (Pierson-Moskowitz as tabulated in offshore practice; three digits)
  EXPECT_NEAR(2.0 * std::numbers::pi / peak_frequency(3.0, 9.81), 8.66, 0.02);
}

TEST(SeaState, WavesObeyTheDeepWaterRelationAndRunWhereAsked) {
  for (const double to_deg : {0.0, 90.0, 225.0}) {
    const auto waves = make_wave_components({.beaufort = 6, .wave_to_deg = to_deg, .components = 200, .seed = 9});
    Eigen::Vector2d flux = Eigen::Vector2d::Zero();
    for (const WaveComponent& wave : waves) {
      // three roundings to single precision
      EXPECT_NEAR(wave.omega * wave.omega, 9.81 * wave.wavenumber, 1e-6 * wave.omega * wave.omega);
      flux += wave.amplitude * wave.amplitude * Eigen::Vector2d(std::cos(wave.direction), std::sin(wave.direction));
    }
    const Eigen::Vector2d asked(std::sin(to_deg * std::numbers::pi / 180), std::cos(to_deg * std::numbers::pi / 180));
    // 200 directions spread evenly over the quantiles: their mean is within a few degrees of the main direction
    EXPECT_GT(flux.normalized().dot(asked), std::cos(6.0 * std::numbers::pi / 180));
    // cos^2s with s falling from 10 at the peak: neither one direction nor all around
    const double order = flux.norm() / (2.0 * wave_variance(waves));
    EXPECT_GT(order, 0.6);
    EXPECT_LT(order, 0.95);
  }
}

TEST(SeaState, TheSeedDecidesAndNothingElse) {
  const SeaState sea{.beaufort = 5, .wave_to_deg = 30, .components = 24, .seed = 7};
  const auto first = make_wave_components(sea), again = make_wave_components(sea);
  SeaState other_sea = sea;
  other_sea.seed = 8;
  const auto other = make_wave_components(other_sea);
  int differing = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].phase, again[i].phase);
    EXPECT_EQ(first[i].direction, again[i].direction);
    EXPECT_EQ(first[i].omega, again[i].omega);
    differing += first[i].phase != other[i].phase;
  }
  EXPECT_GT(differing, 20);
}

TEST(WaveSurface, SlopesAndRateAreTheDerivatives) {
  const auto waves = make_wave_components({.beaufort = 7, .wave_to_deg = 70, .seed = 3});
  const double x = 123.4, y = -56.7, t = 89.0, step = 1e-4;
  const WaveSurface surface = wave_surface(waves, x, y, t);
  EXPECT_DOUBLE_EQ(surface.elevation, wave_elevation(waves, x, y, t));
  const auto difference = [&](double dx, double dy, double dt) {
    return (wave_elevation(waves, x + dx, y + dy, t + dt) - wave_elevation(waves, x - dx, y - dy, t - dt)) / (2 * step);
  };
  // central differences: error step^2/6 of the third derivative, below 1e-7 here
  EXPECT_NEAR(surface.slope.x(), difference(step, 0, 0), 1e-6);
  EXPECT_NEAR(surface.slope.y(), difference(0, step, 0), 1e-6);
  EXPECT_NEAR(surface.rate, difference(0, 0, step), 1e-6);
}

TEST(WaveSurface, CrestsMoveTowardsTheDirection) {
  const std::vector<WaveComponent> wave{{.amplitude = 1, .wavenumber = 0.1f, .omega = 1, .direction = 0, .phase = 0}};
  EXPECT_NEAR(wave_elevation(wave, 0, 0, 0), 1.0, 1e-12);
  EXPECT_NEAR(wave_elevation(wave, 1.0 / 0.1, 5, 1.0), 1.0, 1e-7);  // the phase speed is omega / k; k is a float
}

TEST(WaveDisplacement, KeepsTheMeanLevelAndSharpensCrests) {
  // Lagrangian surface: the mean over space of z dx/dX must vanish (the volume under the waves is that at rest).
  const std::vector<WaveComponent> wave{
      {.amplitude = 2, .wavenumber = 0.1f, .omega = 1, .direction = 0, .phase = 0.3f}};
  const int samples = 4000;
  const double length = 2.0 * std::numbers::pi / static_cast<double>(wave[0].wavenumber);
  double volume = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double x0 = length * i / samples, x1 = length * (i + 1) / samples;
    const auto a = wave_displacement(wave, x0, 0, 0), b = wave_displacement(wave, x1, 0, 0);
    volume += 0.5 * (a.z() + b.z()) * ((x1 + b.x()) - (x0 + a.x()));
  }
  EXPECT_NEAR(volume / length, 0.0, 1e-5);                  // trapezoids: error falls with samples^2
  EXPECT_GT(wave_displacement(wave, -3.0, 0, 0).z(), 2.0);  // at the crest: a + k a^2 / 2
}

}  // namespace
}  // namespace pelagos
