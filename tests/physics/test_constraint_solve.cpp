#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "pair_scene.hpp"
#include "physics/constraint_solve.hpp"

namespace pelagos::test {
namespace {

constexpr double kSpacing = 0.05, kRadius = 0.1;
/// How far A p of the two methods may be apart, of its size: measured, see MethodsAgree.
constexpr double kMethodsApart = 1e-2;

/// A block whose particles stand 2 % too close, slightly disordered, and its density constraint.
class ConstraintSolve : public testing::Test {
 protected:
  ConstraintSolve() {
    std::vector<Float4> points = lattice({10, 9, 8}, 0.98 * kSpacing);
    jitter(points, 0.05 * kSpacing, 21);
    scene_ = std::make_unique<PairScene>(pool_, points, std::span<const Float4>{}, kSpacing, kRadius);
    source_.resize(padded_count(scene_->count));
    for (std::size_t i = 0; i < scene_->count; ++i) source_[i] = scene_->delta[i] - 1.0F;
    memory_.assign(padded_count(scene_->count), 0.0F);
  }

  SolveReport solve(const SolveSettings& settings, float warm_factor = 0.0F) {
    const ConstraintProblem problem{&scene_->data, &scene_->gradients, source_, warm_factor};
    std::uint32_t passes = 0;
    const SolveReport report = solve_constraint(pool_, problem, settings, memory_, work_, passes);
    EXPECT_GE(passes, 2U * static_cast<std::uint32_t>(report.iterations));
    return report;
  }

  /// A p for the solution, from the passes themselves.
  [[nodiscard]] std::vector<float> image() {
    std::vector<float> image = scene_->rate(pool_, scene_->displacement(pool_, work_.pressure), false);
    for (float& a : image) a = -a;
    return image;
  }
  /// The solver's measure of error, evaluated afresh.
  [[nodiscard]] double residual() {
    const std::vector<float> a = image();
    double sum = 0.0;
    for (std::size_t i = 0; i < scene_->count; ++i) {
      const auto r = static_cast<double>(source_[i] - a[i]);
      sum += work_.pressure[i] > 0.0F ? std::abs(r) : std::max(r, 0.0);
    }
    return sum / static_cast<double>(scene_->count);
  }
  void expect_pressure_not_negative() const {
    for (std::size_t i = 0; i < scene_->count; ++i) ASSERT_GE(work_.pressure[i], 0.0F) << i;
  }

  TaskPool pool_{2};
  std::unique_ptr<PairScene> scene_;
  std::vector<float> source_, memory_;
  SolveWorkspace work_;
};

SolveSettings settings(SolveMethod method, double tolerance, int max_iterations = 100) {
  SolveSettings s;
  s.method = method;
  s.tolerance = tolerance;
  s.max_iterations = max_iterations;
  return s;
}

TEST_F(ConstraintSolve, BothMethodsReachTheTolerance) {
  for (const SolveMethod method : {SolveMethod::kConjugateGradient, SolveMethod::kJacobi})
    for (const double tolerance : {1e-3, 3e-4, 1e-4}) {
      const SolveReport report = solve(settings(method, tolerance, 500));
      EXPECT_TRUE(report.converged);
      EXPECT_LT(report.residual, tolerance);
      EXPECT_GE(report.iterations, 2);
      // The running residual and a fresh one differ by the rounding of single precision over the iterations.
      EXPECT_NEAR(residual(), report.residual, 1e-6);
      expect_pressure_not_negative();
    }
}

TEST_F(ConstraintSolve, DisplacementBelongsToThePressure) {
  static_cast<void>(solve(settings(SolveMethod::kConjugateGradient, 1e-4)));
  const std::vector<Float4> fresh = scene_->displacement(pool_, work_.pressure);
  for (std::size_t i = 0; i < scene_->count; ++i) {
    const Double3 off = minus(as_double(work_.displacement[i]), as_double(fresh[i]));
    // Corrections are some 1e-2 d here; summed up over ten moves, single precision keeps 1e-6 of them.
    ASSERT_LT(std::sqrt(dot(off, off)), 1e-6 * kSpacing) << i;
  }
}

TEST_F(ConstraintSolve, MethodsAgree) {
  // The quadratic problem has one A p (p itself may differ where A is singular).
  const double tolerance = 2e-6;
  EXPECT_TRUE(solve(settings(SolveMethod::kConjugateGradient, tolerance, 3000)).converged);
  const std::vector<float> conjugate = image();
  EXPECT_TRUE(solve(settings(SolveMethod::kJacobi, tolerance, 3000)).converged);
  const std::vector<float> jacobi = image();
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < scene_->count; ++i) {
    apart += std::abs(static_cast<double>(conjugate[i] - jacobi[i]));
    size += std::abs(static_cast<double>(conjugate[i]));
  }
  EXPECT_LT(apart, kMethodsApart * size);
}

TEST_F(ConstraintSolve, WarmStartNeedsFewerIterations) {
  const SolveSettings s = settings(SolveMethod::kConjugateGradient, 3e-5, 500);
  const int cold = solve(s).iterations;
  ASSERT_GT(cold, 3);
  const SolveReport warm = solve(s, 1.0F);  // the memory of the cold solve is its solution
  EXPECT_TRUE(warm.converged);
  EXPECT_LE(warm.iterations, s.min_iterations);
  EXPECT_LT(residual(), s.tolerance);
}

TEST_F(ConstraintSolve, AWrongWarmStartIsRepaired) {
  for (const SolveMethod method : {SolveMethod::kConjugateGradient, SolveMethod::kJacobi}) {
    Random random(22);
    for (std::size_t i = 0; i < scene_->count; ++i) memory_[i] = static_cast<float>(random.uniform(0, 5e-4));
    const SolveReport report = solve(settings(method, 3e-4, 500), 1.0F);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(residual(), 3.1e-4);
    expect_pressure_not_negative();
  }
}

TEST_F(ConstraintSolve, MemoryFollowsThePressureWithAFilter) {
  static_cast<void>(solve(settings(SolveMethod::kConjugateGradient, 1e-4)));
  const std::vector<float> first = memory_;
  for (std::size_t i = 0; i < scene_->count; ++i) ASSERT_EQ(first[i], work_.pressure[i]);  // cold: the pressure itself
  static_cast<void>(solve(settings(SolveMethod::kConjugateGradient, 1e-4), 0.25F));
  for (std::size_t i = 0; i < scene_->count; ++i) {
    const float start = source_[i] > -0.05F ? 0.25F * first[i] : 0.0F, p = work_.pressure[i];
    const float expected = start > 0.0F ? 0.2F * p + 0.8F * start : p;
    ASSERT_NEAR(memory_[i], expected, 1e-9F) << i;  // pressures are below 1e-3 m2: rounding of single precision
  }
}

TEST_F(ConstraintSolve, NothingToDoGivesNothing) {
  std::fill(source_.begin(), source_.end(), 0.0F);
  for (const SolveMethod method : {SolveMethod::kConjugateGradient, SolveMethod::kJacobi}) {
    const SolveReport report = solve(settings(method, 3e-4));
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.residual, 0.0);
    EXPECT_LE(report.iterations, 2);
    for (std::size_t i = 0; i < scene_->count; ++i) {
      ASSERT_EQ(work_.pressure[i], 0.0F);
      ASSERT_EQ(dot(as_double(work_.displacement[i]), as_double(work_.displacement[i])), 0.0);
    }
  }
}

TEST_F(ConstraintSolve, WaterDoesNotPull) {
  for (float& b : source_) b = -0.01F;  // everywhere thinner than at rest: no pressure at all
  std::fill(memory_.begin(), memory_.end(), 0.0F);
  const SolveReport report = solve(settings(SolveMethod::kConjugateGradient, 3e-4));
  EXPECT_TRUE(report.converged);
  for (std::size_t i = 0; i < scene_->count; ++i) ASSERT_EQ(work_.pressure[i], 0.0F);
}

TEST_F(ConstraintSolve, KeepsToItsBoundOfIterations) {
  for (const SolveMethod method : {SolveMethod::kConjugateGradient, SolveMethod::kJacobi}) {
    const SolveReport report = solve(settings(method, 1e-12, 3));
    EXPECT_EQ(report.iterations, 3);
    EXPECT_FALSE(report.converged);
    EXPECT_GT(report.residual, 1e-12);
    EXPECT_NEAR(residual(), report.residual, 1e-6);
  }
}

TEST_F(ConstraintSolve, EndsWhenToleranceIsBelowRounding) {
  const SolveReport report = solve(settings(SolveMethod::kConjugateGradient, 1e-12, 400));
  EXPECT_LE(report.iterations, 400);
  // The running residual may go on falling; the one evaluated afresh stays at single precision of numbers of size 0.1.
  EXPECT_LT(residual(), 1e-6);
  expect_pressure_not_negative();
}

TEST_F(ConstraintSolve, AFaultySourceIsLeftOut) {
  source_[5] = std::numeric_limits<float>::quiet_NaN();
  for (const SolveMethod method : {SolveMethod::kConjugateGradient, SolveMethod::kJacobi}) {
    const SolveReport report = solve(settings(method, 3e-4, 50));
    EXPECT_LE(report.iterations, 50);
    for (std::size_t i = 0; i < scene_->count; ++i) {
      ASSERT_TRUE(std::isfinite(work_.pressure[i])) << i;
      ASSERT_TRUE(std::isfinite(work_.displacement[i].x)) << i;
      ASSERT_TRUE(std::isfinite(memory_[i])) << i;
    }
  }
}

TEST(ConstraintSolveSizes, NoParticlesAreConvergedAtOnce) {
  TaskPool pool(2);
  const PairScene scene(pool, {}, {}, kSpacing, kRadius);
  std::vector<float> source(padded_count(0)), memory(padded_count(0));
  SolveWorkspace work;
  for (const SolveMethod method : {SolveMethod::kConjugateGradient, SolveMethod::kJacobi}) {
    std::uint32_t passes = 0;
    const ConstraintProblem problem{&scene.data, &scene.gradients, source, 0.0F};
    const SolveReport report = solve_constraint(pool, problem, settings(method, 3e-4), memory, work, passes);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.residual, 0.0);
  }
}

}  // namespace
}  // namespace pelagos::test
