#include <gtest/gtest.h>

#include <cmath>

#include "../support/csv.hpp"
#include "../support/places.hpp"
#include "pair_scene.hpp"
#include "physics/kernel.hpp"

namespace pelagos::test {
namespace {

const std::string kData = test::source_path("tests/physics/data/");

TEST(CubicSpline, IntegratesToOne) {
  const double radius = 0.13;
  const CubicSpline kernel(radius);
  const int steps = 2000;
  double integral = 0.0;  // midpoint rule on the shells: its own error is (1/steps)^2, far below single precision
  for (int k = 0; k < steps; ++k) {
    const double r = (k + 0.5) * radius / steps;
    integral += 4.0 * M_PI * r * r * static_cast<double>(kernel.value(static_cast<float>(r))) * radius / steps;
  }
  EXPECT_NEAR(integral, 1.0, 2e-6);  // single precision kernel values
}

TEST(CubicSpline, DerivativeMatchesFiniteDifferences) {
  const double radius = 0.2, step = 1e-4 * radius;
  const CubicSpline kernel(radius);
  const ReferenceSpline reference{radius};
  const double scale = reference.sigma() / radius;
  for (double r = 0.01 * radius; r < 0.99 * radius; r += 0.007 * radius) {
    const double slope = (reference.value(r + step) - reference.value(r - step)) / (2.0 * step);
    // The second derivative jumps at q = 0.5 and 1: a difference over 2e-4 of the radius is off by some 1e-3 there.
    EXPECT_NEAR(static_cast<double>(kernel.derivative(static_cast<float>(r))), slope, 2e-3 * scale)
        << "q " << r / radius;
  }
}

TEST(CubicSpline, VanishesFromTheSupportRadiusOn) {
  const CubicSpline kernel(0.1);
  for (const float r : {0.1F, 0.1000001F, 0.2F, 1e9F}) {
    EXPECT_EQ(kernel.value(r), 0.0F) << r;
    EXPECT_EQ(kernel.derivative(r), 0.0F) << r;
  }
  EXPECT_EQ(kernel.derivative(0.0F), 0.0F);
}

TEST(CubicSpline, MatchesReferenceValues) {
  int rows = 0;
  for (const auto& row : read_csv(kData + "kernel_values.csv")) {
    const double radius = 0.25, q = std::stod(row[2]), cubed = radius * radius * radius;
    const CubicSpline kernel(radius);
    const auto r = static_cast<float>(q * radius);
    // Ten digits in the table, single precision in the kernel (differences of numbers of the size of 8).
    EXPECT_NEAR(static_cast<double>(kernel.value(r)) * cubed, std::stod(row[3]), 3e-6) << "q " << q;
    EXPECT_NEAR(static_cast<double>(kernel.derivative(r)) * cubed * radius, std::stod(row[4]), 1e-5) << "q " << q;
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

}  // namespace
}  // namespace pelagos::test
