#include <gtest/gtest.h>

#include <cmath>

#include "../support/csv.hpp"
#include "../support/places.hpp"
#include "waves/splitmix.hpp"
#include "wind/perlin_noise.hpp"

namespace pelagos {
namespace {

TEST(PerlinNoise, ReproducesTheReferenceValues) {
  const auto rows = test::read_csv(test::source_path("tests/wind/data/perlin_improved_noise_values.csv"));
  ASSERT_EQ(rows.size(), 15u);
  for (const auto& row : rows) {
    const double x = std::stod(row[0]), y = std::stod(row[1]), z = std::stod(row[2]);
    EXPECT_NEAR(perlin_noise(x, y, z), std::stod(row[3]), 1e-12) << x << ' ' << y << ' ' << z;  // order of sums
  }
}

TEST(PerlinNoise, HasThePublishedStatistics) {
  SplitMix64 random(11);
  const int count = 100000;
  double sum = 0.0, squares = 0.0, least = 0.0, largest = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = 256 * random.next_unit(), y = 256 * random.next_unit(), z = 256 * random.next_unit();
    const double value = perlin_noise(x, y, z);
    sum += value;
    squares += value * value;
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  EXPECT_NEAR(sum / count, 0.0, 0.004);                     // 0.272 / sqrt(count) = 0.0009
  EXPECT_NEAR(std::sqrt(squares / count), 0.27232, 0.004);  // reference over 2e5 points
  EXPECT_GE(least, -1.04);                                  // sqrt(3/4) bound of the noise, with margin
  EXPECT_LE(largest, 1.04);
}

TEST(PerlinNoise, IsContinuousAndRepeatsAfter256) {
  for (int i = 0; i < 100; ++i) {
    const double x = 0.37 * i - 20, y = 1.7 * i, z = -0.9 * i;
    EXPECT_NEAR(perlin_noise(x, y, z), perlin_noise(x + 256, y - 256, z + 512), 1e-10);
    EXPECT_NEAR(perlin_noise(x - 1e-6, y, z), perlin_noise(x + 1e-6, y, z), 1e-5);  // slope below 3
  }
  EXPECT_TRUE(std::isfinite(perlin_noise(1e15, -1e15, 1e300)));  // far away, yet in range
}

}  // namespace
}  // namespace pelagos
