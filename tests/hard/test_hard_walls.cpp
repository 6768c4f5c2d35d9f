#include <gtest/gtest.h>

#include <cstdio>

#include "moving_walls.hpp"

namespace pelagos::hard {
namespace {

class HardWalls : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, HardWalls, testing::ValuesIn(kSolvers),
                         [](const testing::TestParamInfo<std::string>& s) { return s.param; });

TEST_P(HardWalls, ABucketThatTurnsKeepsItsWaterAndSpinsItUp) {
  const WallOutcome out = rotate_bucket(GetParam(), 4.0, 100);
  RecordProperty("angular_speed", std::to_string(out.angular_speed));
  RecordProperty("largest_speed", std::to_string(out.water.largest_speed));
  EXPECT_TRUE(out.water.sound());
  EXPECT_EQ(out.leaked, 0U);
  EXPECT_GT(out.angular_speed, 1.0);  // of 4 rad/s: corners push it along
  EXPECT_LT(out.angular_speed, 6.0);
  EXPECT_LT(out.water.largest_speed, 5.0);  // the corners run at 1.7 m/s
}

TEST_P(HardWalls, APistonAtFourFifthsOfASpacingAStep) {
  for (const double reach : {0.1, 0.2, 0.4, 0.8}) {
    SCOPED_TRACE(reach);
    const WallOutcome out = push_piston(GetParam(), reach);
    std::printf("%s piston %.1f: leaked %zu, outside %u, largest density %.3f, speed %.1f\n", GetParam().c_str(), reach,
                out.leaked, out.water.outside, out.water.largest_density, out.water.largest_speed);
    EXPECT_TRUE(out.water.sound());
    EXPECT_EQ(out.leaked, 0U);
  }
}

}  // namespace
}  // namespace pelagos::hard
