// Where oil goes at hulls, quays and walls: against closed forms in the plane.

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/open_water.hpp"
#include "small_patch.hpp"

namespace pelagos {
namespace {

constexpr double kSpacing = 0.4, kClearance = 0.25 * kSpacing;

bool everywhere(const Eigen::Vector2d&) { return true; }

/// Bodies in a closed patch of 40 x 20 m about the origin, as oil meets them at z = 0.
class OpenWaterTest : public testing::Test {
 protected:
  BodySettings& add(const Primitive& shape, const Eigen::Vector2d& place, double turned_deg = 0.0) {
    BodySettings body;
    body.id = static_cast<std::uint32_t>(scene_.bodies.size() + 1);
    body.primitive = shape;
    body.drive = BodyDrive::kStatic;
    body.position = {place.x(), place.y(), 0.0};
    body.orientation = Eigen::AngleAxisd(turned_deg * M_PI / 180.0, Eigen::Vector3d::UnitZ());
    return scene_.bodies.emplace_back(body);
  }
  const OpenWater& water() {
    scene_.particle_spacing = kSpacing;
    scene_.patch = {{-20, -10, -3}, {20, 10, 3}};
    Refusals faults;
    bodies_ = Bodies(pool_, scene_, 2.0 * kSpacing, faults);
    EXPECT_TRUE(faults.empty()) << faults.front();
    return water_.emplace(bodies_, patch_, std::array{0.0, 0.0}, kSpacing);
  }

  TaskPool pool_{1};
  Scene scene_;
  Bodies bodies_;
  SlickPatch patch_{{-20, -10}, {20, 10}, {true, true}};
  std::optional<OpenWater> water_;
};

TEST_F(OpenWaterTest, OilStopsStraightAtAWallAndSlidesAlongItByItsWayAlone) {
  for (const double turned : {0.0, 17.0, 90.0, 133.0}) {
    scene_.bodies.clear();
    add(BoxShape{{6.0, 2.0, 2.0}}, {1.0, 2.0}, turned);
    const OpenWater& open = water();
    const Eigen::Rotation2Dd turn(turned * M_PI / 180.0);
    const Eigen::Vector2d middle(1.0, 2.0), off = turn * Eigen::Vector2d(0, 1), along = turn * Eigen::Vector2d(1, 0);
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d from = middle + side * 1.4 * off, stop = middle + side * (1.0 + kClearance) * off;
      EXPECT_LT((open.go(from, from - side * 0.8 * off) - stop).norm(), 1e-8) << turned;
      EXPECT_LT((open.go(stop, stop - side * 0.05 * off) - stop).norm(), 1e-8) << "and it stays there";
      const Eigen::Vector2d slid = open.go(stop, stop + 0.5 * along - side * 0.5 * off);
      EXPECT_LT((slid - stop - 0.5 * along).norm(), 1e-7) << turned;
      EXPECT_LT((open.go(stop, stop + side * 0.3 * off) - stop - side * 0.3 * off).norm(), 1e-9) << "it may leave";
    }
  }
}

TEST_F(OpenWaterTest, OilStaysInACornerAndGoesPastNoThinWall) {
  add(BoxShape{{0.2, 30.0, 2.0}}, {5.0, 0.0});  // across the patch, thinner than a spacing
  const OpenWater& open = water();
  const Eigen::Vector2d corner(5.0 - 0.1 - kClearance, 10.0);
  EXPECT_LT((open.go({4.0, 9.5}, {7.0, 12.0}) - corner).norm(), 1e-6);
  EXPECT_LT((open.go(corner, corner + Eigen::Vector2d(0.3, 0.2)) - corner).norm(), 1e-8);
  EXPECT_LT(open.go({-15.0, 0.0}, {15.0, 0.0}).x(), 5.0);
}

TEST_F(OpenWaterTest, TheWayOutIsTheShortestOne) {
  for (const double turned : {0.0, 31.0, 90.0}) {
    scene_.bodies.clear();
    add(BoxShape{{8.0, 3.0, 2.0}}, {-2.0, 1.0}, turned);
    const OpenWater& open = water();
    const Eigen::Rotation2Dd turn(turned * M_PI / 180.0);
    for (const double x : {-3.9, -1.3, 0.0, 2.2, 3.4})
      for (const double y : {-1.45, -0.95, 0.35, 1.2}) {
        const double beside = 1.5 - std::abs(y), ahead = 4.0 - std::abs(x);
        const Eigen::Vector2d expected = beside < ahead ? Eigen::Vector2d(0.0, std::copysign(beside + kClearance, y))
                                                        : Eigen::Vector2d(std::copysign(ahead + kClearance, x), 0.0);
        const auto way = open.way_out(Eigen::Vector2d(-2.0, 1.0) + turn * Eigen::Vector2d(x, y), {0, 0}, everywhere);
        ASSERT_TRUE(way);
        // The search marches in steps of a thousandth of a spacing.
        EXPECT_LT((*way - turn * expected).norm(), 0.01 * kSpacing) << x << ", " << y << ", turned by " << turned;
      }
  }
}

TEST_F(OpenWaterTest, EquallyShortWaysAreToldApartByTheWaterNotByTheSearch) {
  add(BoxShape{{8.0, 3.0, 2.0}}, {0.0, 0.0});
  const OpenWater& open = water();
  for (const double side : {1.0, -1.0}) {
    const auto way = open.way_out({0.7, 0.0}, {0.0, 0.2 * side}, everywhere);
    ASSERT_TRUE(way);
    EXPECT_LT((*way - Eigen::Vector2d(0.0, side * (1.5 + kClearance))).norm(), 0.01 * kSpacing);
  }
}

TEST_F(OpenWaterTest, OilComesOutOfARoundHullAlongItsRadius) {
  add(CylinderShape{2.0, 3.0}, {0.0, 0.0});
  const OpenWater& open = water();
  for (const double angle : {0.1, 1.0, 2.5, 4.0}) {
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    const auto way = open.way_out(1.2 * out, {0, 0}, everywhere);
    ASSERT_TRUE(way);
    // The hull is a prism of facets: its nearest one is off the radius by half a facet at most.
    EXPECT_NEAR(way->norm(), 0.8 + kClearance, 0.05);
    EXPECT_GT(way->normalized().dot(out), 0.99);
  }
}

TEST_F(OpenWaterTest, TheWayOutCrossesNoQuay) {
  add(BoxShape{{6.0, 2.0, 2.0}}, {0.0, 0.0});
  add(BoxShape{{12.0, 0.5, 2.0}}, {0.0, 1.3});  // 0.05 m off the hull; open water 0.5 m behind it
  const OpenWater& open = water();
  const auto way = open.way_out({1.0, 0.9}, {0, 0}, everywhere);
  ASSERT_TRUE(way);
  const Eigen::Vector2d out = Eigen::Vector2d(1.0, 0.9) + *way;
  EXPECT_LT(out.y(), 1.05) << "in the gap, or under the hull to its other side";
  EXPECT_GE(open.distance(out, 1.0), 0.0);
  // Oil in the gap, nearer to both than it keeps off one, stays or goes along.
  const Eigen::Vector2d gap(0.0, 1.025);
  EXPECT_LT((open.go(gap, gap + Eigen::Vector2d(0.0, 0.2)) - gap).norm(), 0.026);
}

TEST_F(OpenWaterTest, ThereMayBeNoWayOut) {
  add(BoxShape{{60.0, 40.0, 2.0}}, {0.0, 0.0});
  EXPECT_FALSE(water().way_out({1.0, 2.0}, {0, 0}, everywhere));
}

}  // namespace
}  // namespace pelagos
