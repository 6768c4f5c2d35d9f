// An hour of a sea as an array of wave gauges records it: height, period and direction are those asked for.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "scales/angles.hpp"
#include "waves/sea_generator.hpp"
#include "waves/wave_field.hpp"
#include "waves/wave_spectrum.hpp"

namespace pelagos {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kSamples = 8192;
constexpr double kSeconds = 3600.0;
constexpr std::size_t kProbes = 5;
/// m: a star with arms of different lengths.
constexpr std::array<float, kProbes> kX{0.0F, 18.0F, -7.0F, 3.0F, -25.0F}, kY{0.0F, 4.0F, 15.0F, -31.0F, -6.0F};

/// Of each probe: elevation in m, and velocity at the mean level in m/s.
struct Record {
  std::array<std::vector<double>, kProbes> elevation, east, north;
};

Record record_of(const WaveField& field) {
  Record record;
  std::array<float, kProbes> level{}, elevation{}, slope_x{}, slope_y{}, rate{}, u{}, v{}, w{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const WaveMoment moment = field.at(kSeconds * static_cast<double>(i) / kSamples, {0.0, 0.0});
    evaluate_surface(moment, kX, kY, {elevation, slope_x, slope_y, rate});
    evaluate_motion(moment, kX, kY, level, Stretching::kNone, {u, v, w, {}, {}, {}, {}});
    for (std::size_t probe = 0; probe < kProbes; ++probe) {
      record.elevation[probe].push_back(elevation[probe]);
      record.east[probe].push_back(u[probe]);
      record.north[probe].push_back(v[probe]);
    }
  }
  return record;
}

void transform(std::vector<std::complex<double>>& values) {
  const std::size_t count = values.size();
  if (count == 1) return;
  std::vector<std::complex<double>> even(count / 2), odd(count / 2);
  for (std::size_t i = 0; i < count / 2; ++i) {
    even[i] = values[2 * i];
    odd[i] = values[2 * i + 1];
  }
  transform(even);
  transform(odd);
  for (std::size_t i = 0; i < count / 2; ++i) {
    const auto turned = std::polar(1.0, -kTurn * static_cast<double>(i) / static_cast<double>(count)) * odd[i];
    values[i] = even[i] + turned;
    values[i + count / 2] = even[i] - turned;
  }
}

/// What the record says of a sea.
struct Measured {
  double height = 0.0, mean_period = 0.0, to_deg = 0.0;
};

Measured measure(const Record& record) {
  double m0 = 0.0, m1 = 0.0, east = 0.0, north = 0.0;
  for (std::size_t probe = 0; probe < kProbes; ++probe) {
    std::vector<std::complex<double>> spectrum(kSamples);
    for (std::size_t i = 0; i < kSamples; ++i) {
      spectrum[i] = record.elevation[probe][i];
      east += record.elevation[probe][i] * record.east[probe][i];
      north += record.elevation[probe][i] * record.north[probe][i];
    }
    transform(spectrum);
    for (std::size_t i = 1; i < kSamples / 2; ++i) {
      const double energy = 2.0 * std::norm(spectrum[i]) / (static_cast<double>(kSamples) * kSamples);
      m0 += energy;
      m1 += energy * kTurn * static_cast<double>(i) / kSeconds;
    }
  }
  return {4.0 * std::sqrt(m0 / kProbes), kTurn * m0 / m1, std::atan2(east, north) * kDegreesPerRadian};
}

struct RecordCase {
  std::string name;
  WaveSystem system;
  std::uint32_t components;
};

class SeaRecord : public testing::TestWithParam<RecordCase> {};

TEST_P(SeaRecord, OfAnHourHasTheHeightThePeriodAndTheDirectionAskedFor) {
  const WaveSystem& system = GetParam().system;
  const double peak = peak_period(system, kInfiniteDepth, kStandardGravity);
  const SpectrumMoments m = WaveSpectrum(system, peak, kInfiniteDepth, kStandardGravity).moments();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const SeaSettings sea{{system}, GetParam().components, seed, 0.0};
    const Measured measured = measure(record_of(WaveField(make_sea_components(sea).waves, 0.0)));
    EXPECT_NEAR(measured.height, system.height, 0.03 * system.height) << seed;
    EXPECT_NEAR(measured.mean_period * m[1] / m[0], peak, 0.05 * peak) << seed;
    EXPECT_LT(std::abs(std::remainder(measured.to_deg - system.to_deg, 360.0)), 3.0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Seas, SeaRecord,
    testing::Values(
        RecordCase{"WindSea", {.height = 2.0, .period = 7.0, .to_deg = 250.0}, 100},
        RecordCase{"WindSeaOfManyComponents", {.height = 2.0, .period = 7.0, .to_deg = 250.0}, 300},
        RecordCase{"Swell",
                   {.height = 1.5,
                    .period = 13.0,
                    .to_deg = 20.0,
                    .spreading_kind = SpreadingKind::kConstant,
                    .spreading = 50.0,
                    .gamma = 7.0},
                   120},
        RecordCase{"Developed", {.spectrum = SpectrumKind::kPiersonMoskowitz, .height = 4.0, .to_deg = 135.0}, 100}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace pelagos
