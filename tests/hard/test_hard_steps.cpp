#include <gtest/gtest.h>

#include <string>

#include "hard_water.hpp"

namespace pelagos::hard {
namespace {

// Steps that are too long, and very many of them. Where a bound is a figure that was measured, twice it is allowed.

class HardSteps : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static bool corrected() { return GetParam() == "corrected"; }
};
INSTANTIATE_TEST_SUITE_P(Solvers, HardSteps, testing::ValuesIn(kSolvers),
                         [](const testing::TestParamInfo<std::string>& s) { return s.param; });

void record(const Outcome& out, const std::string& prefix = "") {
  const auto put = [&](const std::string& name, double value) {
    testing::Test::RecordProperty(prefix + name, std::to_string(value));
  };
  put("density_error", out.density_error);
  put("energy_rise", out.energy_rise);
  put("late_rms_speed", out.late_rms_speed);
  put("density_iterations", out.density_iterations);
  put("velocity_iterations", out.velocity_iterations);
}

TEST_P(HardSteps, ADamBreakWithTwiceTheUsualStep) {
  HardWater water(small_dam(GetParam()));
  water.settle(60);
  water.run(0.8, 0.14, 0.4);
  const Outcome out = water.outcome();
  record(out);
  EXPECT_TRUE(out.sound());
  EXPECT_TRUE(water.all_there());
  EXPECT_LT(out.density_error, 9e-4);  // measured: 4.3e-4 (dfsph)
  EXPECT_LT(out.energy_rise, 0.012);   // measured: 5.6e-3 (corrected: its repair lifts), 1e-4 (others)
}

TEST_P(HardSteps, ThreeThousandStepsOfStillWater) {
  HardWater water(still_column(GetParam(), 10, 3e-4));
  water.settle(100);
  const double height = water.mean_height();
  water.run(3000 * 0.07 * water.step_unit(), 0.07, 0.4);
  const Outcome out = water.outcome();
  record(out);
  RecordProperty("height_drift", std::to_string((water.mean_height() - height) / 0.05));
  EXPECT_TRUE(out.sound());
  EXPECT_TRUE(water.all_there());
  EXPECT_NEAR(water.mean_height(), height, 0.13 * 0.05);  // measured: 0.063 spacings lower
  // m/s; measured: 0.001 to 0.032 (the lattice gives way now and then, at a time that is chance).
  EXPECT_LT(out.late_rms_speed, 0.065);
  EXPECT_LT(out.energy_rise, 0.0026);  // measured: 1.3e-3 (corrected), at most 9e-4 (others)
}

TEST_P(HardSteps, ThreeThousandStepsOfSloshing) {
  HardWater water(sloshing_tank(GetParam()));
  water.settle(60);
  water.run(3000 * 0.07 * water.step_unit(), 0.07, 0.4);
  const Outcome out = water.outcome();
  record(out);
  EXPECT_TRUE(out.sound());
  EXPECT_TRUE(water.all_there());
  EXPECT_LT(out.energy_rise, 0.0015);  // measured: at most 7e-4
}

TEST_P(HardSteps, StillWaterFifteenAndThirtyLayersDeep) {
  for (const int layers : {15, 30}) {
    SCOPED_TRACE(layers);
    HardWater water(still_column(GetParam(), layers, 1e-4));
    water.settle(100);
    water.run(300 * 0.07 * water.step_unit(), 0.07, 0.4);
    const Outcome out = water.outcome();
    record(out, "layers_" + std::to_string(layers) + "_");
    EXPECT_TRUE(out.sound());
    EXPECT_LT(out.energy_rise, 0.0025);                            // measured: 1.2e-3 (corrected), 2e-4 (others)
    EXPECT_LT(out.late_rms_speed, corrected() ? 0.13 : 0.08);      // m/s, still settling; measured: 0.065 and 0.040
    EXPECT_LT(out.density_iterations, layers == 15 ? 8.6 : 18.0);  // measured: at most 4.3 and 9.2
  }
}

/// Before the corrected scheme had measures for depth, the sea of 80 layers fell into itself: 5 % of compression by
/// now.
TEST(HardDepth, AStillSeaOfSixtyAndEightyLayersStaysWhole) {
  for (const int layers : {60, 80}) {
    SCOPED_TRACE(layers);
    HardWater water(still_sea("corrected", layers, 3e-4));
    water.run(7.0 * water.step_unit(), 0.07, 0.4);
    const Outcome out = water.outcome();
    record(out, "layers_" + std::to_string(layers) + "_");
    EXPECT_TRUE(out.sound());
    EXPECT_LT(out.density_error, 0.02);   // while the lattice breaks up; measured: 1.8e-3 and 7e-3
    EXPECT_LT(out.largest_density, 1.3);  // measured: 1.04 and 1.13
    EXPECT_LT(out.late_rms_speed, 0.4);   // m/s; the collapse made 1
  }
}

}  // namespace
}  // namespace pelagos::hard
