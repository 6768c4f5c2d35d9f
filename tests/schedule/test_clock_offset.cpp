#include "schedule/clock_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pelagos {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// An exchange that begins `at` (ns here) with a clock that is `ahead` (ns), by ways that take so long (ns).
ClockStamps exchange(std::int64_t at, std::int64_t ahead, std::int64_t out, std::int64_t back) {
  const std::int64_t there = 50'000;
  return {at, at + out + ahead, at + out + there + ahead, at + out + there + back};
}

TEST(ClockOffsetFilter, FindsTheOffset) {
  ClockOffsetFilter filter;
  EXPECT_FALSE(filter.offset(0));
  EXPECT_TRUE(filter.add(exchange(1000 * kMs, 300 * kMs, kMs, kMs)));
  const ClockOffset offset = filter.offset(1002 * kMs).value();
  EXPECT_NEAR(offset.seconds, 0.3, 1e-9);
  EXPECT_NEAR(offset.error, 1e-3, 1e-6) << "half of the way there and back";
  EXPECT_EQ(offset.answers, 1U);
}

TEST(ClockOffsetFilter, UnequalWaysStayWithinTheErrorThatItTells) {
  for (const std::int64_t out : {0, 1, 5, 40}) {
    ClockOffsetFilter filter;
    EXPECT_TRUE(filter.add(exchange(0, -7'000 * kMs, out * kMs, 2 * kMs)));
    const ClockOffset offset = filter.offset(0).value();
    EXPECT_LE(std::abs(offset.seconds + 7.0), offset.error + 1e-9) << out;
  }
}

TEST(ClockOffsetFilter, TakesTheShortestWay) {
  ClockOffsetFilter filter;
  std::mt19937 random(3);
  std::exponential_distribution<double> queue(1.0 / 20.0);  // ms, one way or the other
  double best = 1e9;
  for (int i = 0; i < 16; ++i) {
    const auto out = static_cast<std::int64_t>(0.2e6 + 1e6 * queue(random)),
               back = static_cast<std::int64_t>(0.2e6 + 1e6 * queue(random));
    best = std::min(best, 1e-9 * static_cast<double>(out + back));
    EXPECT_TRUE(filter.add(exchange(i * 250 * kMs, 123'456'789'000, out, back)));
  }
  const ClockOffset offset = filter.offset(16 * 250 * kMs).value();
  EXPECT_LE(std::abs(offset.seconds - 123.456789), offset.error);
  EXPECT_LE(offset.error, 0.5 * best + 1e-3) << "with the drift of four seconds";
  EXPECT_EQ(offset.answers, 16U);
}

TEST(ClockOffsetFilter, LetsOldAnswersGo) {
  ClockOffsetFilter filter;
  EXPECT_TRUE(filter.add(exchange(0, 0, kMs, kMs)));
  EXPECT_NEAR(filter.offset(60'000 * kMs)->error, 1e-3 + 60.0 * ClockOffsetFilter::kMostDrift, 1e-4);
  EXPECT_FALSE(filter.offset(200'000 * kMs)) << "the answers have been lost for too long";
  EXPECT_TRUE(filter.add(exchange(200'000 * kMs, kMs, 5 * kMs, 5 * kMs)));
  EXPECT_NEAR(filter.offset(200'011 * kMs)->seconds, 1e-3, 1e-9);
}

TEST(ClockOffsetFilter, RefusesWhatCannotBe) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max(),
                         kLeast = std::numeric_limits<std::int64_t>::min();
  const ClockStamps good = exchange(0, 0, kMs, kMs);
  ClockOffsetFilter filter;
  const auto with = [&](auto field, std::int64_t value) {
    ClockStamps stamps = good;
    stamps.*field = value;
    return stamps;
  };
  for (const auto field : {&ClockStamps::asked, &ClockStamps::received, &ClockStamps::answered, &ClockStamps::returned})
    for (const std::int64_t value : {kMost, kLeast, ClockOffsetFilter::kMostNs + 1})
      EXPECT_FALSE(filter.add(with(field, value)));
  EXPECT_FALSE(filter.add(with(&ClockStamps::returned, -kMs))) << "back before it was asked";
  EXPECT_FALSE(filter.add(with(&ClockStamps::answered, 0))) << "answered before it was received";
  EXPECT_FALSE(filter.add(with(&ClockStamps::answered, 100 * kMs))) << "stayed there for longer than it was away";
  EXPECT_FALSE(filter.add(with(&ClockStamps::returned, 3'000 * kMs))) << "took too long";
  EXPECT_FALSE(filter.offset(0));
  EXPECT_TRUE(filter.add(good));
}

TEST(ClockOffsetFilter, HoldsClocksThatCountFromFarApart) {
  ClockOffsetFilter filter;
  const std::int64_t ahead = ClockOffsetFilter::kMostNs - 1000 * kMs;
  EXPECT_TRUE(filter.add(exchange(100 * kMs, ahead, kMs, kMs)));
  EXPECT_NEAR(static_cast<double>(filter.offset(100 * kMs)->ns - ahead), 0.0, 2.0);
  EXPECT_TRUE(filter.add({ClockOffsetFilter::kMostNs - 5, -ClockOffsetFilter::kMostNs, -ClockOffsetFilter::kMostNs + 1,
                          ClockOffsetFilter::kMostNs}));
}

}  // namespace
}  // namespace pelagos
