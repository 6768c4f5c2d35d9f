#include <gtest/gtest.h>

#include <limits>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

TEST(Appearance, FollowsTheBonnAgreementCode) {
  EXPECT_EQ(appearance(0.0), OilAppearance::kNone);
  EXPECT_EQ(appearance(0.039e-6), OilAppearance::kNone);
  EXPECT_EQ(appearance(0.04e-6), OilAppearance::kSheen);
  EXPECT_EQ(appearance(0.29e-6), OilAppearance::kSheen);
  EXPECT_EQ(appearance(0.3e-6), OilAppearance::kRainbow);
  EXPECT_EQ(appearance(4.9e-6), OilAppearance::kRainbow);
  EXPECT_EQ(appearance(5e-6), OilAppearance::kMetallic);
  EXPECT_EQ(appearance(49e-6), OilAppearance::kMetallic);
  EXPECT_EQ(appearance(50e-6), OilAppearance::kDiscontinuousTrue);
  EXPECT_EQ(appearance(200e-6), OilAppearance::kDiscontinuousTrue);
  EXPECT_EQ(appearance(201e-6), OilAppearance::kContinuousTrue);
  EXPECT_EQ(appearance(std::numeric_limits<double>::quiet_NaN()), OilAppearance::kNone);
  EXPECT_EQ(appearance(-1.0), OilAppearance::kNone);
}

TEST(Frame, HoldsEveryElement) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(2.0, {10.0, -4.0}, 3.0));
  const SlickFrame frame = layer.frame();
  ASSERT_EQ(frame.discs.size(), 1u);
  const SlickDisc& disc = frame.discs[0];
  EXPECT_FLOAT_EQ(disc.x, 10.0f);
  EXPECT_FLOAT_EQ(disc.y, -4.0f);
  EXPECT_FLOAT_EQ(disc.radius, 3.0f);
  EXPECT_FLOAT_EQ(disc.mass, 2.0f);
  const double thickness = 2.0 / layer.settings().oil.density / (std::numbers::pi * 9.0);
  EXPECT_NEAR(disc.thickness, thickness, 1e-9);
  EXPECT_EQ(disc.appearance, OilAppearance::kDiscontinuousTrue);  // 80 um
  EXPECT_FALSE(disc.contained);
}

TEST(CoveredArea, CountsOverlapsOnce) {
  SlickElement a, b;
  a.size = b.size = 1.0 / kDiscPerSize;
  a.mass = b.mass = 1;
  EXPECT_NEAR(covered_area(std::vector{a}), std::numbers::pi, 1e-9);
  EXPECT_NEAR(covered_area(std::vector{a, b}), std::numbers::pi, 1e-9);
  b.position = {1.0, 0.0};  // two unit discs a unit apart share 2 pi / 3 - sqrt(3) / 2
  EXPECT_NEAR(covered_area(std::vector{a, b}),
              2.0 * std::numbers::pi - (2.0 * std::numbers::pi / 3.0 - std::sqrt(0.75)), 0.1);
  b.position = {5.0, 0.0};
  EXPECT_NEAR(covered_area(std::vector{a, b}), 2.0 * std::numbers::pi, 1e-9);
}

TEST(Statistics, DescribeALoneElement) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(2.0, {0.0, 0.0}, 3.0));
  const SlickStatistics s = layer.statistics();
  EXPECT_NEAR(s.area, std::numbers::pi * 9.0, 1e-6);
  EXPECT_NEAR(s.volume, 2.0 / layer.settings().oil.density, 1e-12);
  EXPECT_NEAR(s.mean_thickness, s.volume / s.area, 1e-12);
  EXPECT_NEAR(s.largest_thickness, s.mean_thickness, 1e-9);
  EXPECT_NEAR(s.median_thickness, s.mean_thickness, 1e-9);
}

TEST(Statistics, PercentilesAreByArea) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(1.0, {0.0, 0.0}, 1.0));
  ASSERT_FALSE(layer.release(1.0, {100.0, 0.0}, 10.0));  // a hundred times the area, a hundredth of the thickness
  const SlickStatistics s = layer.statistics();
  EXPECT_LT(s.median_thickness, 0.011 * s.largest_thickness);
  EXPECT_LT(s.percentile_90, 0.011 * s.largest_thickness);
}

}  // namespace
}  // namespace pelagos
