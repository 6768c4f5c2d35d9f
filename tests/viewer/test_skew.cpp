#include "source/skew.hpp"

#include <gtest/gtest.h>

namespace pelagos {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(Skew, IsTheMagnitudeOverTheLastTenSeconds) {
  Skew skew;
  EXPECT_EQ(skew.recent(0.99), 0.0);
  skew.add(0, 5.0);
  for (int i = 0; i < 100; ++i) skew.add(20 * kSecond + i, i % 2 == 0 ? -1e-3 : 1e-3);
  EXPECT_DOUBLE_EQ(skew.recent(0.5), 1e-3);
  EXPECT_DOUBLE_EQ(skew.recent(1.0), 1e-3) << "what was 20 s ago counts no more";
  ASSERT_EQ(skew.all_ms().size(), 101U);
  EXPECT_DOUBLE_EQ(skew.all_ms().front(), 5000.0);
}

TEST(Skew, TheLastPercentShowsInNinetyNine) {
  Skew skew;
  for (int i = 0; i < 1000; ++i) skew.add(i, i < 980 ? 1e-3 : 0.1);
  EXPECT_DOUBLE_EQ(skew.recent(0.5), 1e-3);
  EXPECT_DOUBLE_EQ(skew.recent(0.99), 0.1);
}

TEST(SwapForecast, LooksBackAtTheLastPictures) {
  SwapForecast forecast;
  EXPECT_EQ(forecast.seconds(1.0), 0.0);
  forecast.add(9.0);
  for (std::size_t i = 0; i < SwapForecast::kMost; ++i) forecast.add(i == 7 ? 0.03 : 0.01);
  EXPECT_DOUBLE_EQ(forecast.seconds(0.5), 0.01);
  EXPECT_DOUBLE_EQ(forecast.seconds(1.0), 0.03);
}

}  // namespace
}  // namespace pelagos
