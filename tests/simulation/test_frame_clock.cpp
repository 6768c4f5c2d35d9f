#include <gtest/gtest.h>

#include "simulation/frame_clock.hpp"

namespace pelagos {
namespace {

using enum FrameTimes;

TEST(FrameClock, LandsExactlyOnMultiplesOfTheInterval) {
  FrameClock clock(1.0 / 30.0);
  for (std::uint64_t frame = 1; frame <= 3000; ++frame) {
    const double admissible = 0.0007 + 0.0001 * static_cast<double>(frame % 97);  // steps that never divide evenly
    while (!clock.advance(clock.choose_step(admissible, kEven), kEven)) {
    }
    ASSERT_EQ(clock.frame(), frame);
    ASSERT_EQ(clock.time(), static_cast<double>(frame) * (1.0 / 30.0));  // bit for bit
  }
}

TEST(FrameClock, NeverExceedsTheAdmissibleStep) {
  FrameClock clock(0.1);
  for (int k = 0; k < 1000; ++k) {
    const double admissible = k % 7 == 0 ? 1.0 : 0.013 + 0.0003 * (k % 11);
    const double dt = clock.choose_step(admissible, kEven);
    // 1e-9 of a step may be added so as not to cut a frame into one step more than needed.
    EXPECT_LE(dt, admissible * (1.0 + 1e-8));
    EXPECT_GT(dt, 0.0);
    clock.advance(dt, kEven);
  }
}

TEST(FrameClock, OneStepSufficesWhereItMayBeAsLongAsTheFrame) {
  FrameClock clock(0.02);
  EXPECT_DOUBLE_EQ(clock.choose_step(5.0, kEven), 0.02);
  EXPECT_TRUE(clock.advance(0.02, kEven));
  EXPECT_EQ(clock.frame(), 1U);
}

TEST(FrameClock, AtStepsShortensNoStepAndTellsEachFrameOnce) {
  FrameClock clock(1.0 / 30.0);
  double time = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double admissible = 0.0007 + 0.0003 * (k % 97);  // up to 29 ms, less than a frame
    ASSERT_EQ(clock.choose_step(admissible, kAtSteps), admissible);
    const double due = static_cast<double>(clock.frame() + 1) / 30.0;
    const bool reached = clock.advance(admissible, kAtSteps);
    time += admissible;
    ASSERT_EQ(clock.time(), time);
    ASSERT_EQ(reached, time >= due - 1e-9);
    ASSERT_LT(clock.time() - static_cast<double>(clock.frame()) / 30.0, 1.0 / 30.0 + 1e-9);
  }
}

TEST(FrameClock, AtStepsMakesAFrameEachStepWhereStepsMayBeLonger) {
  FrameClock clock(0.02);
  for (std::uint64_t frame = 1; frame <= 1000; ++frame) {
    const double dt = clock.choose_step(0.03, kAtSteps);
    ASSERT_EQ(dt, 0.02);
    ASSERT_TRUE(clock.advance(dt, kAtSteps));
    ASSERT_EQ(clock.frame(), frame);
  }
}

}  // namespace
}  // namespace pelagos
