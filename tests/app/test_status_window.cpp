#include "status_window.hpp"

#include <gtest/gtest.h>

namespace pelagos {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

StepReport step_of(double dt, double error) {
  StepReport report;
  report.dt = dt;
  report.density_error = error;
  return report;
}

TEST(StatusWindow, TellsRealTimeFactorAndHeadroomOfTheLastSecond) {
  StatusWindow window(0);
  for (int k = 0; k < 50; ++k) window.add(step_of(0.02, 1e-4), 0.01);
  ServerStatus status;
  EXPECT_FALSE(window.roll(kSecond / 2, status));
  EXPECT_TRUE(window.roll(kSecond, status));
  EXPECT_NEAR(status.real_time_factor, 1.0, 1e-12);
  EXPECT_NEAR(status.achievable_real_time_factor, 2.0, 1e-12);
  EXPECT_NEAR(status.step_ms, 10.0, 1e-9);
  EXPECT_NEAR(status.density_error, 1e-4, 1e-15);
  EXPECT_FALSE(window.roll(kSecond + 1, status));
}

TEST(StatusWindow, ForgetsTimeSpentPaused) {
  StatusWindow window(0);
  for (int k = 0; k < 50; ++k) window.add(step_of(0.02, 0), 0.01);
  ServerStatus status;
  window.roll(kSecond, status);
  window.skip_to(100 * kSecond);
  for (int k = 0; k < 50; ++k) window.add(step_of(0.02, 0), 0.01);
  window.roll(101 * kSecond, status);
  EXPECT_NEAR(window.whole_run(101 * kSecond).real_time_factor(), 1.0, 1e-9);
}

}  // namespace
}  // namespace pelagos
