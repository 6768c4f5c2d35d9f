// Short waves that are drawn only: their sums, their spectrum, and that all channels have the same.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/fourier.hpp"
#include "renderer/short_waves.hpp"
#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {
namespace {

using Complex = std::complex<float>;

TEST(FourierSquare, IsTheSumOfItsTerms) {
  constexpr std::size_t kSide = 8;
  std::vector<Complex> grid(kSide * kSide);
  SplitMix64 random(5);
  for (Complex& value : grid)
    value = {static_cast<float>(random.next_unit()) - 0.5F, static_cast<float>(random.next_unit()) - 0.5F};
  const std::vector<Complex> terms = grid;
  FourierSquare(kSide).sum(grid);
  for (std::size_t y = 0; y < kSide; ++y)
    for (std::size_t x = 0; x < kSide; ++x) {
      std::complex<double> sum;
      for (std::size_t v = 0; v < kSide; ++v)
        for (std::size_t u = 0; u < kSide; ++u) {
          const double turns = static_cast<double>(u * x + v * y) / kSide;
          sum += std::complex<double>(terms[v * kSide + u]) * std::polar(1.0, 2.0 * std::numbers::pi * turns);
        }
      // 64 terms of size 0.5 in single precision
      EXPECT_LT(std::abs(std::complex<double>(grid[y * kSide + x]) - sum), 1e-5) << x << " " << y;
    }
}

std::vector<MomentWave> sea_of(int beaufort, double time = 0.0) {
  const WaveField field(make_wave_components({.beaufort = beaufort, .wave_to_deg = 40, .components = 60, .seed = 4}),
                        0.0);
  return field.at(time, {0.0, 0.0}).waves;
}

struct Slopes {
  double x = 0.0, y = 0.0;  ///< mean squares
  double foam = 0.0;        ///< mean
  [[nodiscard]] double sum() const { return x + y; }
};

Slopes slopes_of(const ShortWaveTile& tile) {
  Slopes mean;
  for (const ShortWaveTile::Texel& texel : tile.texels) {
    const double part = 1.0 / static_cast<double>(tile.texels.size());
    mean.x += part * static_cast<double>(texel.slope_x * texel.slope_x);
    mean.y += part * static_cast<double>(texel.slope_y * texel.slope_y);
    mean.foam += part * static_cast<double>(texel.foam);
  }
  return mean;
}

ShortWaves waves_at(double time, int beaufort, const Eigen::Vector2d& wind) {
  ShortWaves waves(7);
  waves.set_sea(sea_of(beaufort), wind);
  waves.evaluate(time);
  return waves;
}

double slope_variance(const ShortWaves& waves) {
  double sum = waves.variance_below();
  for (const ShortWaveTile& tile : waves.tiles()) sum += slopes_of(tile).sum();
  return sum;
}

TEST(ShortWaves, HaveTheSlopesOfTheWind) {
  // Cox and Munk's mean square slope holds for all waves. What the tiles lack are components longer than 60 m, and at
  // most the share that a random sea of some hundred waves is off (a fifth).
  for (const double wind : {4.0, 9.0, 18.0}) {
    const ShortWaves waves = waves_at(30.0, 2, {wind, 0.0});
    EXPECT_NEAR(slope_variance(waves), mean_square_slope(wind), 0.2 * mean_square_slope(wind)) << wind;
  }
}

TEST(ShortWaves, GrowAndTurnWithTheWind) {
  const ShortWaves calm = waves_at(30.0, 0, {2.0, 0.0}), storm = waves_at(30.0, 0, {20.0, 0.0}),
                   turned = waves_at(30.0, 0, {0.0, 20.0});
  EXPECT_GT(slope_variance(storm), 5.0 * slope_variance(calm));
  const Slopes along = slopes_of(storm.tiles()[1]), across = slopes_of(turned.tiles()[1]);
  // Cox and Munk (1954): all waves have 1.5 times the slopes along the wind; short ones spread wider.
  EXPECT_GT(along.x, 1.1 * along.y) << "crests lie across the wind";
  EXPECT_GT(across.y, 1.1 * across.x);
  EXPECT_LT(slopes_of(calm.tiles()[1]).foam, 1e-5);
  EXPECT_GT(along.foam, 0.002);
  EXPECT_LT(along.foam, 0.3);
}

TEST(ShortWaves, StandInForComponentsThatTheirTilesHold) {
  const ShortWaves waves = waves_at(30.0, 8, {19.0, 0.0});
  double carried = 0.0, shortest = HUGE_VAL;
  for (const MomentWave& wave : sea_of(8)) {
    const double length = 2.0 * std::numbers::pi / static_cast<double>(wave.wavenumber);
    shortest = std::min(shortest, length);
    if (length <= 60.0 && length > 4.0)
      carried += 0.5 * std::pow(static_cast<double>(wave.amplitude * wave.wavenumber), 2);
  }
  ShortWaves without(7);
  without.set_sea({}, {19.0, 0.0});
  without.evaluate(30.0);
  // Without components the wind alone raises waves, of 12 m and less.
  EXPECT_GT(slopes_of(waves.tiles()[0]).sum(), carried);
  EXPECT_LT(slopes_of(without.tiles()[0]).sum(), slopes_of(waves.tiles()[0]).sum());
  EXPECT_NEAR(waves.shortest_component(), shortest, 1e-6);
  EXPECT_EQ(without.shortest_component(), HUGE_VAL);
}

TEST(ShortWaves, AreTheSameInEveryChannel) {
  const ShortWaves first = waves_at(1234.5, 5, {3.0, 8.0});
  ShortWaves second(7);  // has drawn another sea and other times before
  second.set_sea(sea_of(8), {18.0, 1.0});
  second.evaluate(3.0);
  second.set_sea(sea_of(5), {3.0, 8.0});
  second.evaluate(1234.5);
  for (std::size_t t = 0; t < kShortWaveTiles; ++t)
    for (std::size_t i = 0; i < first.tiles()[t].texels.size(); ++i) {
      ASSERT_EQ(first.tiles()[t].texels[i].slope_x, second.tiles()[t].texels[i].slope_x);
      ASSERT_EQ(first.tiles()[t].texels[i].foam, second.tiles()[t].texels[i].foam);
    }
}

TEST(ShortWaves, MoveOnSmoothlyAlsoAfterDays) {
  constexpr double kDay = 86'400.0, kStep = 1e-3;  // s
  ShortWaves waves = waves_at(kDay, 5, {9.0, 0.0});
  const std::vector<ShortWaveTile::Texel> before = waves.tiles()[1].texels;
  waves.evaluate(kDay + kStep);
  double moved = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
    moved = std::max(moved, std::abs(static_cast<double>(waves.tiles()[1].texels[i].slope_x - before[i].slope_x)));
  EXPECT_GT(moved, 0.0);
  // The fastest waves of the tile, 0.7 m long, turn by 9.4 rad/s: 0.0094 of the largest slopes, about 1.
  EXPECT_LT(moved, 0.01);
}

TEST(ShortWaves, BearSeasWithoutWindOrWavesAndImpossibleOnes) {
  ShortWaves waves(1);
  waves.set_sea({}, Eigen::Vector2d::Zero());
  waves.evaluate(0.0);
  EXPECT_GT(slope_variance(waves), 0.0) << "no sea is a mirror";
  EXPECT_LT(slope_variance(waves), 0.01);
  waves.set_sea(sea_of(12), {90.0, -90.0});
  waves.evaluate(-5.0);
  EXPECT_LT(slope_variance(waves), 1.0);
}

}  // namespace
}  // namespace pelagos
