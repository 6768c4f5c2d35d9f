// Components of seas: energy, direction and period are those that were asked for.

#include "waves/sea_generator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scales/angles.hpp"
#include "waves/sea_state.hpp"
#include "waves/wave_spectrum.hpp"

namespace pelagos {
namespace {

constexpr double kGravity = 9.81;
constexpr double kTurn = 2.0 * std::numbers::pi;

struct KindCase {
  std::string name;
  WaveSystem system;
};

WaveSystem sea_of(SpectrumKind kind, double height = 2.0, double period = 7.0, double to_deg = 250.0) {
  WaveSystem system;
  system.spectrum = kind;
  system.height = height;
  system.period = period;
  system.to_deg = to_deg;
  return system;
}

std::vector<KindCase> kinds() {
  std::vector<KindCase> all{{"Jonswap", sea_of(SpectrumKind::kJonswap)},
                            {"JonswapSharp", sea_of(SpectrumKind::kJonswap, 1.5, 13.0, 10.0)},
                            {"PiersonMoskowitz", sea_of(SpectrumKind::kPiersonMoskowitz, 4.0, 0.0, 0.0)},
                            {"Tma", sea_of(SpectrumKind::kTma, 1.0, 8.0, 359.0)},
                            {"OchiHubble", sea_of(SpectrumKind::kOchiHubble, 3.0, 12.0, 90.0)},
                            {"OchiHubbleBroad", sea_of(SpectrumKind::kOchiHubble, 3.0, 8.0, 180.0)},
                            {"Constant", sea_of(SpectrumKind::kJonswap, 0.5, 3.0, 45.0)},
                            {"Broad", sea_of(SpectrumKind::kJonswap, 0.5, 3.0, 45.0)},
                            {"LongCrested", sea_of(SpectrumKind::kJonswap, 2.0, 6.0, 300.0)},
                            {"ByZeroCrossing", sea_of(SpectrumKind::kJonswap, 2.0, 5.0, 120.0)},
                            {"ByMean", sea_of(SpectrumKind::kPiersonMoskowitz, 2.0, 5.0, 120.0)},
                            {"Regular", sea_of(SpectrumKind::kRegular, 2.0, 9.0, 200.0)}};
  all[1].system.gamma = 10.0;
  all[4].system.shape = 3.0;
  all[5].system.shape = 0.7;
  all[6].system.spreading_kind = SpreadingKind::kConstant;
  all[6].system.spreading = 25.0;
  all[7].system.spreading_kind = SpreadingKind::kConstant;
  all[7].system.spreading = 1.0;
  all[8].system.spreading_kind = SpreadingKind::kLongCrested;
  all[9].system.period_kind = PeriodKind::kZeroCrossing;
  all[10].system.period_kind = PeriodKind::kMean;
  return all;
}

double depth_of(const WaveSystem& system) { return system.spectrum == SpectrumKind::kTma ? 12.0 : kInfiniteDepth; }

struct Means {
  double variance = 0.0, tm01 = 0.0, tm02 = 0.0, to_deg = 0.0;
};
Means means_of(std::span<const WaveComponent> waves) {
  double m0 = 0.0, m1 = 0.0, m2 = 0.0, east = 0.0, north = 0.0;
  for (const WaveComponent& wave : waves) {
    const double energy = 0.5 * static_cast<double>(wave.amplitude) * static_cast<double>(wave.amplitude);
    const double omega = wave.omega, direction = wave.direction;
    m0 += energy;
    m1 += energy * omega;
    m2 += energy * omega * omega;
    east += energy * std::cos(direction);
    north += energy * std::sin(direction);
  }
  return {m0, kTurn * m0 / m1, kTurn * std::sqrt(m0 / m2), std::atan2(east, north) * kDegreesPerRadian};
}

double apart(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360.0)); }

class SeaOfAKind : public testing::TestWithParam<KindCase> {};

TEST_P(SeaOfAKind, HasTheEnergyTheDirectionAndThePeriodAskedFor) {
  const WaveSystem& system = GetParam().system;
  const double depth = depth_of(system);
  const bool regular = system.spectrum == SpectrumKind::kRegular;
  const double variance = system.height * system.height / (regular ? 8.0 : 16.0);
  const double peak = peak_period(system, depth, kGravity);
  const SpectrumMoments m = WaveSpectrum(system, peak, depth, kGravity).moments();
  for (const std::uint32_t count : {1U, 3U, 24U, 100U, 512U})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const SeaSettings sea{{system}, count, seed, 0.0};
      const SeaComponents made = make_sea_components(sea, {kGravity, depth, 1});
      ASSERT_EQ(made.waves.size(), regular ? 1U : count);
      EXPECT_EQ(made.left_out, 0.0);
      const Means means = means_of(made.waves);
      // Amplitudes, frequencies and directions are rounded to single precision.
      EXPECT_NEAR(means.variance, variance, 1e-5 * variance);
      EXPECT_NEAR(made.variance, variance, 1e-9);
      EXPECT_LT(apart(means.to_deg, system.to_deg), 1e-3);
      if (regular) {
        EXPECT_NEAR(means.tm01, system.period, 1e-5);
      } else if (system.period_kind == PeriodKind::kZeroCrossing) {
        EXPECT_NEAR(means.tm02, system.period, 1e-4 * system.period);
      } else {
        const double wanted = system.period_kind == PeriodKind::kMean ? system.period : peak * m[0] / m[1];
        EXPECT_NEAR(means.tm01, wanted, 1e-4 * wanted);
        // The other period is no sum of the bands' own: bands are narrow enough from 24 of them on.
        if (count >= 24) {
          EXPECT_NEAR(means.tm02, peak * std::sqrt(m[0] / m[2]), 0.02 * peak);
        }
      }
      for (const WaveComponent& wave : made.waves) {
        ASSERT_TRUE(wave.amplitude > 0.0F && std::isfinite(wave.direction) && wave.omega > 0.0F);
        // two roundings to single precision, of which one is squared
        EXPECT_NEAR(wave_frequency(wave.wavenumber, depth, kGravity), wave.omega, 2e-6 * wave.omega);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SeaOfAKind, testing::ValuesIn(kinds()), [](const auto& one) { return one.param.name; });

/// Tz and Tm over Tp by gamma, fitted in DNV-RP-C205 (2010), 3.5.5.
TEST(WaveSpectrum, HasTheTabulatedRatiosOfPeriods) {
  for (const double g : {1.0, 2.0, 3.3, 5.0, 7.0}) {
    const double tz = 0.6673 + g * (0.05037 + g * (-0.006230 + g * 0.0003341));
    const double tm = 0.7303 + g * (0.04936 + g * (-0.006556 + g * 0.0003610));
    WaveSystem system = sea_of(SpectrumKind::kJonswap, 2.0, 10.0);
    system.gamma = g;
    const SpectrumMoments m = WaveSpectrum(system, 10.0, kInfiniteDepth, kGravity).moments();
    EXPECT_NEAR(m[0] / m[1], tm, 0.005 * tm) << g;
    // The table ends at 8 times the peak frequency; 2 % of m2 lie above.
    EXPECT_NEAR(std::sqrt(m[0] / m[2]), tz, 0.012 * tz) << g;
    system.period_kind = PeriodKind::kZeroCrossing;
    EXPECT_NEAR(peak_period(system, kInfiniteDepth, kGravity), 10.0 / tz, 0.012 * 10.0 / tz);
  }
}

TEST(WaveSpectrum, OfFullyDevelopedSeasPeaksWherePiersonAndMoskowitzSay) {
  const WaveSystem system = sea_of(SpectrumKind::kPiersonMoskowitz, 3.0, 0.0);
  EXPECT_NEAR(peak_period(system, kInfiniteDepth, kGravity), 5.0 * std::sqrt(3.0), 0.02);
}

TEST(WaveSpectrum, OfShallowWaterLosesItsLongWavesAndIsJonswapWhereItIsDeep) {
  const WaveSystem tma = sea_of(SpectrumKind::kTma, 1.0, 10.0);
  const auto below_peak = [](const WaveSpectrum& spectrum) { return spectrum.moments(0.3, 1.0)[0]; };
  const WaveSpectrum deep(tma, 10.0, kInfiniteDepth, kGravity), five(tma, 10.0, 5.0, kGravity);
  const WaveSpectrum jonswap(sea_of(SpectrumKind::kJonswap, 1.0, 10.0), 10.0, 5.0, kGravity);
  EXPECT_EQ(below_peak(deep), below_peak(jonswap));
  EXPECT_LT(below_peak(five), 0.9 * below_peak(deep));
  // Kitaigorodskii's factor is (omega_h)^2 / 2 where omega_h = omega sqrt(h / g) < 1, within 6 %: so the density at
  // half the peak's frequency falls to 0.10 of what it was, against that far above the peak, where it is 1.
  const double at = kTurn / 10.0 * std::sqrt(5.0 / kGravity);
  ASSERT_LT(at, 1.0);
  const auto density = [&](const WaveSpectrum& s, double r) { return s.moments(r * 0.99, r * 1.01)[0]; };
  const double factor = density(five, 1.0) / density(five, 6.0) / (density(deep, 1.0) / density(deep, 6.0));
  EXPECT_NEAR(factor, 0.5 * at * at, 0.06 * 0.5 * at * at);
}

TEST(WaveSpectrum, BandsResolveThePeakAndTheShortWaves) {
  const WaveSystem system = sea_of(SpectrumKind::kJonswap);
  const WaveSpectrum spectrum(system, 7.0, kInfiniteDepth, kGravity);
  const auto edges = spectrum.band_edges(spectrum.lowest(), spectrum.highest(), 100);
  ASSERT_EQ(edges.size(), 101U);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    EXPECT_GT(edges[i], edges[i - 1]);
    EXPECT_LT(std::log(edges[i] / edges[i - 1]), 1.5 * std::log(spectrum.highest() / spectrum.lowest()) / 100 + 1e-9);
    EXPECT_LT(spectrum.moments(edges[i - 1], edges[i])[0], 0.03 + 1e-9);
  }
}

TEST(SeaGenerator, DealsOutDirectionsThatDoNotFollowTheFrequency) {
  for (const std::uint32_t count : {24U, 100U, 512U})
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      WaveSystem system = sea_of(SpectrumKind::kJonswap, 2.0, 7.0, 90.0);
      system.spreading_kind = SpreadingKind::kConstant;  // so that all have the same spread
      const auto waves = make_sea_components({{system}, count, seed, 0.0}).waves;
      double sum = 0.0, squares = 0.0, with_next = 0.0, with_order = 0.0;
      for (std::size_t i = 0; i < waves.size(); ++i) {
        const double direction = waves[i].direction, order = static_cast<double>(i) / (count - 1.0) - 0.5;
        sum += direction;
        squares += direction * direction;
        with_order += direction * order;
        if (i > 0) with_next += direction * static_cast<double>(waves[i - 1].direction);
      }
      // The correlation with the frequency's rank; random directions would have 1 / sqrt(count).
      EXPECT_LT(std::abs(with_order) / std::sqrt(squares * count / 12.0), 0.2) << count << " seed " << seed;
      EXPECT_LT(with_next, 0.0) << "neighbours lie on different sides";
      // cos^2s(theta/2), s = 10: a standard deviation of about sqrt(2 / (1 + s)) = 0.43
      EXPECT_NEAR(std::sqrt(squares / count), 0.44, 0.06);
    }
}

TEST(SeaGenerator, LeavesShortWavesOutAndTellsTheirEnergy) {
  const WaveSystem wind_sea = sea_of(SpectrumKind::kJonswap, 1.0, 4.0),
                   swell = sea_of(SpectrumKind::kRegular, 1.0, 9.0);
  for (const double shortest : {0.5, 5.0, 12.0, 20.0, 70.0, 200.0}) {
    const SeaSettings sea{{wind_sea, swell}, 60, 3, shortest};
    const SeaComponents made = make_sea_components(sea);
    EXPECT_NEAR(wave_variance(made.waves) + made.left_out, 1.0 / 16.0 + 1.0 / 8.0, 1e-6) << shortest;
    EXPECT_NEAR(made.variance, 1.0 / 16.0 + 1.0 / 8.0, 1e-12);
    for (const WaveComponent& wave : made.waves)
      EXPECT_GT(kTurn / static_cast<double>(wave.wavenumber), shortest * (1.0 - 1e-6));
    const std::size_t expected = shortest > 130.0 ? 0U : shortest > 50.0 ? 1U : 60U;
    EXPECT_EQ(made.waves.size(), expected) << shortest;
  }
  // 12 m: omega 2.27 rad/s, 1.44 of the peak's; a Pierson-Moskowitz sea has 1 - exp(-1.25 / 1.44^4) = 0.252 above it
  const SeaSettings developed{{sea_of(SpectrumKind::kPiersonMoskowitz, 1.0, 4.0)}, 60, 3, 12.0};
  EXPECT_NEAR(make_sea_components(developed).left_out * 16.0, 0.252, 0.003);
}

TEST(SeaGenerator, SharesTheComponentsAmongSystems) {
  const WaveSystem sea = sea_of(SpectrumKind::kJonswap), regular = sea_of(SpectrumKind::kRegular);
  WaveSystem flat = sea;
  flat.height = 0.0;
  using Shares = std::vector<std::uint32_t>;
  EXPECT_EQ(share_components({{sea, regular, sea, flat, sea}, 100, {}, 0.0}), (Shares{33, 1, 33, 0, 33}));
  EXPECT_EQ(share_components({{sea, sea, sea}, 100, {}, 0.0}), (Shares{34, 33, 33}));
  EXPECT_EQ(share_components({{sea, sea}, 2, {}, 0.0}), (Shares{1, 1}));
  EXPECT_EQ(share_components({{regular}, 100, {}, 0.0}), (Shares{1}));
  EXPECT_EQ(share_components({{}, 100, {}, 0.0}), (Shares{}));
  const std::vector<WaveSystem> eight(8, sea);
  EXPECT_EQ(make_sea_components({eight, 512, 1, 0.0}).waves.size(), 512U);
}

TEST(SeaGenerator, TheSeedDecidesAndNothingElse) {
  const WaveSystem sea = sea_of(SpectrumKind::kJonswap), swell = sea_of(SpectrumKind::kJonswap, 1.0, 12.0, 300.0);
  const auto same = [](const WaveComponent& a, const WaveComponent& b) {
    return a.amplitude == b.amplitude && a.omega == b.omega && a.direction == b.direction && a.phase == b.phase;
  };
  const auto first = make_sea_components({{sea, swell}, 48, 7, 0.0}).waves;
  const auto again = make_sea_components({{sea, swell}, 48, {}, 0.0}, {kGravity, kInfiniteDepth, 7}).waves;
  const auto alone = make_sea_components({{sea}, 24, 7, 0.0}).waves;
  const auto other = make_sea_components({{sea, swell}, 48, 8, 0.0}).waves;
  int differing = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(same(first[i], again[i]));
    if (i < alone.size()) {
      EXPECT_TRUE(same(first[i], alone[i])) << "a swell does not change the wind sea";
    }
    differing += first[i].phase != other[i].phase;
  }
  EXPECT_EQ(differing, 48);
}

TEST(Douglas, HasTheMiddleOfEachRange) {
  // WMO code table 3700: 0, to 0.1, 0.5, 1.25, 2.5, 4, 6, 9, 14 m, and over 14 m
  const double tops[] = {0.0, 0.1, 0.5, 1.25, 2.5, 4.0, 6.0, 9.0, 14.0};
  EXPECT_EQ(douglas_wave_height(0), 0.0);
  for (int degree = 1; degree <= 8; ++degree)
    EXPECT_NEAR(douglas_wave_height(degree), 0.5 * (tops[degree - 1] + tops[degree]), 1e-12) << degree;
  EXPECT_EQ(douglas_wave_height(9), 14.0);
  EXPECT_EQ(douglas_wave_height(99), 14.0);
}

}  // namespace
}  // namespace pelagos
