#include <gtest/gtest.h>

#include <string>

#include "hard_water.hpp"

namespace pelagos::hard {
namespace {

// Two liquids of any ratio of densities that a scene may ask for; `pelagos-hard oil` runs them for 100,000 steps.

class HardOil : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Solvers, HardOil, testing::ValuesIn(kSolvers),
                         [](const testing::TestParamInfo<std::string>& s) { return s.param; });

TEST_P(HardOil, ADamBreakUnderOilOfAnyRatio) {
  for (const double ratio : {0.99, 0.5, 0.1, 2.0}) {
    HardWater water(oil_dam(GetParam(), ratio, 2));
    water.settle(60);
    const double longest = 0.07 * water.step_unit();
    for (int n = 0; n < 1000; ++n)
      water.step(std::max(0.1 * longest, admissible_time_step(water.state().parameters, 0.4, longest, water.speed())));
    const Outcome out = water.outcome();
    EXPECT_TRUE(out.sound()) << ratio << ": " << out.outside << " outside";
    EXPECT_TRUE(water.all_there()) << ratio;
    EXPECT_LT(out.density_error, 0.01) << ratio;
    EXPECT_LT(out.energy_rise, 0.01) << ratio;
    std::printf("%s %.2f: density error %.1e, energy rise %.1e, iterations %.1f + %.1f\n", GetParam().c_str(), ratio,
                out.density_error, out.energy_rise, out.density_iterations, out.velocity_iterations);
  }
}

}  // namespace
}  // namespace pelagos::hard
