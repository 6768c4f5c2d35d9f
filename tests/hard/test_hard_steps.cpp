#include <gtest/gtest.h>

#include <cmath>

#include "hard_water.hpp"

namespace pelagos::hard {
namespace {

class HardSteps : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, HardSteps, testing::ValuesIn(kSolvers),
                         [](const testing::TestParamInfo<std::string>& s) { return s.param; });

TEST_P(HardSteps, ADamBreakWithTwiceTheUsualStep) {
  HardWater water(small_dam(GetParam()));
  water.settle(60);
  water.run(0.8, 0.14, 0.4);
  const Outcome out = water.outcome();
  std::printf("%s: error %.2e, rise %.2e\n", GetParam().c_str(), out.density_error, out.energy_rise);
  EXPECT_TRUE(out.sound());
  EXPECT_TRUE(water.all_there());
  EXPECT_LT(out.density_error, 0.05);
  EXPECT_LT(out.energy_rise, 0.05);
}

TEST_P(HardSteps, ThreeThousandStepsOfStillWater) {
  HardWater water(still_column(GetParam(), 10, 3e-4));
  water.settle(100);
  const double height = water.mean_height();
  water.run(3000 * 0.07 * water.step_unit(), 0.07, 0.4);
  const Outcome out = water.outcome();
  std::printf("%s: still: rms %.4f, rise %.2e, height %+.4f d\n", GetParam().c_str(), out.late_rms_speed,
              out.energy_rise, (water.mean_height() - height) / 0.05);
  EXPECT_TRUE(out.sound());
  EXPECT_TRUE(water.all_there());
  EXPECT_NEAR(water.mean_height(), height, 0.25 * 0.05);
  EXPECT_LT(out.late_rms_speed, 0.1);
  EXPECT_LT(out.energy_rise, 0.01);
}

TEST_P(HardSteps, ThreeThousandStepsOfSloshing) {
  HardWater water(sloshing_tank(GetParam()));
  water.settle(60);
  water.run(3000 * 0.07 * water.step_unit(), 0.07, 0.4);
  const Outcome out = water.outcome();
  std::printf("%s: slosh: rms %.4f, rise %.2e\n", GetParam().c_str(), out.late_rms_speed, out.energy_rise);
  EXPECT_TRUE(out.sound());
  EXPECT_TRUE(water.all_there());
  EXPECT_LT(out.energy_rise, 0.01);
}

TEST_P(HardSteps, StillWaterFifteenAndThirtyLayersDeep) {
  for (const int layers : {15, 30}) {
    SCOPED_TRACE(layers);
    HardWater water(still_column(GetParam(), layers, 1e-4));
    water.settle(100);
    water.run(300 * 0.07 * water.step_unit(), 0.07, 0.4);
    const Outcome out = water.outcome();
    std::printf("%s: %d layers: iterations %.1f + %.1f, rms %.4f, rise %.2e\n", GetParam().c_str(), layers,
                out.density_iterations, out.velocity_iterations, out.late_rms_speed, out.energy_rise);
    EXPECT_TRUE(out.sound());
    EXPECT_LT(out.energy_rise, 0.01);
    EXPECT_LT(out.late_rms_speed, 0.1);
  }
}

}  // namespace
}  // namespace pelagos::hard
