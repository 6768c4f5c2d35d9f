#include <gtest/gtest.h>

#include <limits>

#include "source/latency.hpp"

namespace pelagos {
namespace {

constexpr std::int64_t kNow = 1'700'000'000'000'000'000;  // ns since 1970
constexpr std::int64_t kMs = 1'000'000;

/// Frames that took `way_ms` to come here and 40 ms to draw, with the server's clock `behind_ms` behind ours.
Latency measured(std::initializer_list<int> way_ms, std::int64_t behind_ms) {
  Latency latency;
  const auto drawn = std::chrono::steady_clock::now();
  for (const int way : way_ms) {
    OceanFrame frame;
    frame.received = drawn - std::chrono::milliseconds(40);
    frame.wall_time_ns = kNow - (40 + way + behind_ms) * kMs;
    latency.add(frame, drawn, kNow);
  }
  return latency;
}

TEST(Latency, IsThatOfTheServersClockWhereBothAgree) {
  const Latency latency = measured({5, 2, 30}, 0);
  EXPECT_EQ(latency.clock_difference(), 0.0);
  ASSERT_EQ(latency.from_server().size(), 3U);
  EXPECT_NEAR(latency.from_server()[0], 45.0, 1e-3);  // ns since 1970 in a double: 0.3 us
  EXPECT_NEAR(latency.from_arrival()[0], 40.0, 1e-6);
}

TEST(Latency, ClocksThatDifferGiveTheDifferenceInstead) {
  for (const std::int64_t hour_ms : {-3'600'000, 3'600'000}) {
    const Latency latency = measured({5, 2, 30}, hour_ms);
    EXPECT_TRUE(latency.from_server().empty());
    ASSERT_TRUE(latency.clock_difference());
    EXPECT_NEAR(*latency.clock_difference(), 1e-3 * static_cast<double>(hour_ms + 2), 1e-3);
    EXPECT_EQ(latency.from_arrival().size(), 3U) << "which needs one clock only";
  }
  EXPECT_TRUE(measured({5}, -6).from_server().empty()) << "a frame came before it was made";
}

TEST(Latency, NothingIsKnownWithoutAFrame) {
  EXPECT_FALSE(Latency().clock_difference());
  EXPECT_TRUE(Latency().from_server().empty());
}

TEST(Latency, TimesThatNobodyHasAreNoFault) {
  Latency latency;
  OceanFrame frame;
  frame.wall_time_ns = std::numeric_limits<std::int64_t>::min();
  latency.add(frame, frame.received, kNow);
  EXPECT_GT(latency.clock_difference().value(), 1e9);
  EXPECT_TRUE(latency.from_server().empty());
}

}  // namespace
}  // namespace pelagos
