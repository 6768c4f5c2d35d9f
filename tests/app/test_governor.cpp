#include "governor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pelagos {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr Effort kExact{0.005, 3e-4, 3e-4};

Scene scene_with(double budget, double largest_tolerance = 2.4e-3, double largest_step = 0.01) {
  Scene scene;
  scene.governor = {true, budget, largest_tolerance, largest_step};
  return scene;
}

/// Seconds that a frame takes under an effort: by the number of steps, and a little by the tolerance.
double cost_of(const Effort& effort, double at_exact) {
  return at_exact * (kExact.max_step / effort.max_step) *
         std::pow(kExact.divergence_tolerance / effort.divergence_tolerance, 0.15);
}

/// Runs so many frames; returns how often the effort changed.
int run(Governor& governor, int frames, double at_exact) {
  int changes = 0;
  for (int frame = 0; frame < frames; ++frame)
    changes += governor.observe(cost_of(governor.effort(), at_exact)) ? 1 : 0;
  return changes;
}

TEST(Governor, LeavesExactWhatFitsTheBudget) {
  Governor governor(scene_with(0.02), kExact);
  EXPECT_EQ(run(governor, 1000, 0.019), 0);
  EXPECT_EQ(governor.effort(), kExact);
  EXPECT_FALSE(governor.over_budget());
}

TEST(Governor, PaysOnlyAsMuchAsItMustStepsFirst) {
  Governor governor(scene_with(0.02), kExact);
  EXPECT_EQ(run(governor, 1000, 0.023), 1);  // one rung makes it 0.0193
  EXPECT_GT(governor.effort().max_step, kExact.max_step);
  EXPECT_EQ(governor.effort().divergence_tolerance, kExact.divergence_tolerance);
  EXPECT_LE(cost_of(governor.effort(), 0.023), 0.02);
}

TEST(Governor, StaysWithinTheScenesBoundsAndSaysWhenTheyAreNotEnough) {
  Governor governor(scene_with(0.02), kExact);
  run(governor, 1000, 1.0);
  EXPECT_EQ(governor.effort(), (Effort{0.01, 2.4e-3, 2.4e-3}));
  EXPECT_TRUE(governor.over_budget());
  run(governor, 30, 0.02);  // the smoothed time forgets a second within 20 frames or so
  EXPECT_FALSE(governor.over_budget()) << "and when they are again";
}

TEST(Governor, TellsAMissedBudgetFromAMachineThatIsTooSlow) {
  Governor governor(scene_with(0.02), kExact);
  run(governor, 100, 0.08);  // 0.03 s at the bounds: over the budget
  ASSERT_TRUE(governor.over_budget());
  EXPECT_THAT(governor.advice(0.04), HasSubstr("real time is held, the budget is missed"));
  EXPECT_THAT(governor.advice(0.04), Not(HasSubstr("cannot keep up")));
  EXPECT_THAT(governor.advice(0.025), HasSubstr("this machine cannot keep up"));
  EXPECT_THAT(governor.advice(std::nullopt), StartsWith("the budget is missed")) << "a run without a clock to follow";
}

TEST(Governor, ClimbsAtOnceWhereAFrameIsFarOverTheBudget) {
  Governor governor(scene_with(0.02), kExact);
  EXPECT_EQ(run(governor, 3, 1.0), 1);
  EXPECT_EQ(governor.effort(), (Effort{0.01, 2.4e-3, 2.4e-3}));
  run(governor, 3, 1.0);
  EXPECT_TRUE(governor.over_budget()) << "said within 6 frames";
}

TEST(Governor, DoesNotClimbHigherThanAFarOverTimeNeeds) {
  Governor governor(scene_with(0.02, 0.05, 0.02), kExact);
  run(governor, 40, 0.042);  // 2.1 times: 4 rungs of steps and a little
  EXPECT_EQ(governor.effort().density_tolerance, kExact.density_tolerance);
  EXPECT_LE(cost_of(governor.effort(), 0.042), 0.02);
}

TEST(Governor, ComesBackToExactWhereThereIsRoom) {
  Governor governor(scene_with(0.02), kExact);
  run(governor, 500, 0.06);
  ASSERT_NE(governor.effort(), kExact);
  run(governor, 2000, 0.005);
  EXPECT_EQ(governor.effort(), kExact);
}

TEST(Governor, DoesNotFlutterUnderASteadyLoad) {
  // Whatever the load, an effort is found and then kept: after 500 frames none of the next 5000 changes it more than
  // now and then. A rung at 0.75 of the budget costs at most 1.19 times as much below: no way back up.
  for (const double at_exact : {0.0201, 0.022, 0.025, 0.03, 0.035, 0.05}) {
    Governor governor(scene_with(0.02), kExact);
    run(governor, 500, at_exact);
    EXPECT_EQ(run(governor, 5000, at_exact), 0) << at_exact;
  }
}

TEST(Governor, WaitsLongerAfterEachDescentThatDidNotHold) {
  // Two efforts only, and the exact one costs twice as much: whatever is chosen is wrong for a rule without memory.
  Governor governor(scene_with(0.02, 3e-4, kExact.max_step * 1.15), kExact);
  const auto changes_in = [&](int frames) {
    int changes = 0;
    for (int frame = 0; frame < frames; ++frame)
      changes += governor.observe(governor.effort() == kExact ? 0.025 : 0.0125) ? 1 : 0;
    return changes;
  };
  const int first = changes_in(1000), later = changes_in(1000), much_later = changes_in(4000);
  EXPECT_GT(first, later);
  EXPECT_LE(much_later, 4);  // patience is beyond a thousand frames by then
}

TEST(Governor, TakesTheDefaultsOfTheScene) {
  Scene scene = scene_with(0.0, 1e-2, 0.0);
  scene.frame_interval = 0.05;
  Governor governor(scene, kExact);
  EXPECT_NEAR(governor.budget(), 0.04, 1e-15);
  run(governor, 1000, 10.0);
  EXPECT_EQ(governor.effort().max_step, kExact.max_step) << "no longer step unless the scene allows it";
  EXPECT_EQ(governor.effort().density_tolerance, 1e-2);
}

TEST(Governor, SameTimesGiveTheSameChoices) {
  Governor one(scene_with(0.02), kExact), two(scene_with(0.02), kExact);
  for (int frame = 0; frame < 3000; ++frame) {
    const double seconds = 0.01 + 0.03 * ((frame * 37) % 101) / 101.0;
    EXPECT_EQ(one.observe(seconds), two.observe(seconds));
  }
}

}  // namespace
}  // namespace pelagos
