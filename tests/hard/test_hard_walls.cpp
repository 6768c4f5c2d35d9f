#include <gtest/gtest.h>

#include <string>

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

void record_piston(const WallOutcome& out) {
  testing::Test::RecordProperty("leaked", std::to_string(out.leaked));
  testing::Test::RecordProperty("outside", std::to_string(out.water.outside));
  testing::Test::RecordProperty("largest_density", std::to_string(out.water.largest_density));
}

TEST_P(HardWalls, APistonUpToTwoFifthsOfASpacingAStepLeaksNothing) {
  for (const double reach : {0.1, 0.2, 0.4}) {
    SCOPED_TRACE(reach);
    const WallOutcome out = push_piston(GetParam(), reach, PistonSteps::kFixed);
    record_piston(out);
    EXPECT_TRUE(out.water.sound());
    EXPECT_EQ(out.leaked, 0U);
  }
}

TEST_P(HardWalls, AFasterPistonLeaksNothingWithStepsThatFollowItsSpeed) {
  const WallOutcome out = push_piston(GetParam(), 0.8, PistonSteps::kAdaptive);
  record_piston(out);
  EXPECT_TRUE(out.water.sound());
  EXPECT_EQ(out.leaked, 0U);
}

TEST_P(HardWalls, AFasterPistonWithFixedStepsLeaksButStaysFinite) {
  // One layer of samples passes particles by when it moves 0.8 d a step. Measured: up to 74 of 1776 behind the wall and
  // 11 outside; twice that is allowed.
  const WallOutcome out = push_piston(GetParam(), 0.8, PistonSteps::kFixed);
  record_piston(out);
  EXPECT_EQ(out.water.not_finite, 0U);
  EXPECT_LT(out.leaked, 150U);
  EXPECT_LT(out.water.outside, 23U);
}

}  // namespace
}  // namespace pelagos::hard
