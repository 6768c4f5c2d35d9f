#include "convergence_watch.hpp"

#include <gmock/gmock.h>

#include "status_window.hpp"

namespace pelagos {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr Effort kEffort{0.005, 3e-4, 1e-3};

StepReport missed(double density_residual) {
  StepReport report;
  report.dt = 0.005;
  report.density = {100, density_residual, false};
  return report;
}

TEST(ConvergenceWatch, SaysNothingWhereEverythingConverged) {
  ConvergenceWatch watch;
  watch.add(StepReport{}, kEffort);
  EXPECT_EQ(watch.take(), "");
}

TEST(ConvergenceWatch, NamesConstraintResidualToleranceAndWhatToChange) {
  ConvergenceWatch watch;
  watch.add(StepReport{}, kEffort);
  watch.add(missed(4e-4), kEffort);
  watch.add(missed(5e-4), kEffort);
  EXPECT_THAT(watch.take(), AllOf(HasSubstr("density constraint"), HasSubstr("2 of 3 steps"),
                                  HasSubstr("0.0005 against 0.0003"), HasSubstr("100 iterations"),
                                  HasSubstr("solver.density.max_iterations"), Not(HasSubstr("divergence"))));
  EXPECT_EQ(watch.take(), "") << "told once";
}

TEST(ConvergenceWatch, StatusCountsStepsNotConstraints) {
  StatusWindow window(0);
  StepReport both = missed(4e-4);
  both.divergence = {100, 2e-3, false};
  window.add(both, 0.001);
  window.add(StepReport{}, 0.001);
  ServerStatus status;
  ASSERT_TRUE(window.roll(1'000'000'000, status));
  EXPECT_EQ(status.unconverged_steps, 1U);
  window.add(StepReport{}, 0.001);
  ASSERT_TRUE(window.roll(2'000'000'000, status));
  EXPECT_EQ(status.unconverged_steps, 0U) << "of the last second only";
}

}  // namespace
}  // namespace pelagos
