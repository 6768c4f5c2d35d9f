#include "polygon.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace pelagos {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d area_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return 0.5 * (b - a).cross(c - a);
}

/// Cuts a polygon in each of its rotations and both orders, in a plane that leans, and checks all that is promised.
void check(const Points& flat, double least_part) {
  const Eigen::AngleAxisd lean(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  for (const bool back : {false, true})
    for (std::size_t start = 0; start < flat.size(); ++start) {
      Points corners;
      for (std::size_t n = 0; n < flat.size(); ++n) {
        const std::size_t at = back ? flat.size() - 1 - n : n;
        corners.emplace_back(lean * flat[(at + start) % flat.size()] + Eigen::Vector3d(100, -50, 7));
      }
      std::vector<std::array<std::uint32_t, 3>> triangles;
      std::uint64_t work = 0;
      ASSERT_TRUE(cut_polygon(corners, triangles, work)) << start << back;
      ASSERT_EQ(triangles.size(), corners.size() - 2);
      Eigen::Vector3d whole = Eigen::Vector3d::Zero();
      for (std::size_t n = 1; n + 1 < corners.size(); ++n) whole += area_of(corners[0], corners[n], corners[n + 1]);
      const Eigen::Vector3d front = whole.normalized();
      double sum = 0.0;
      for (const auto& [a, b, c] : triangles) {
        const double area = area_of(corners[a], corners[b], corners[c]).dot(front);
        EXPECT_GT(area, least_part * whole.norm()) << start << back;
        sum += area;
      }
      EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm()) << "none covers another";
    }
}

TEST(CutPolygon, ConvexOnes) {
  check({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 0.4);
  Points circle;
  for (int n = 0; n < 40; ++n)
    circle.emplace_back(std::cos(n * std::numbers::pi / 20), std::sin(n * std::numbers::pi / 20), 0);
  check(circle, 1e-4);
}

TEST(CutPolygon, CornersInTheMiddleOfEdges) {
  check({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 0.2);
  check({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, 0.4);
  check({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1.5, 0}, {3, 3, 0}, {1.5, 1.5, 0}}, 0.05);
  Points rail;  // many on one edge, one corner across
  for (int n = 0; n <= 20; ++n) rail.emplace_back(0.1 * n, 0, 0);
  rail.emplace_back(1, 1, 0);
  check(rail, 0.04);
  Points thirds{{0, 0, 0}, {1.0 / 3, 0.1 / 3, 0}, {2.0 / 3, 0.2 / 3, 0}, {1, 0.1, 0}, {1, 1, 0}, {0, 1, 0}};
  check(thirds, 0.01);  // on the edge but for rounding
}

TEST(CutPolygon, ConcaveOnes) {
  check({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}, 0.4);                    // an arrow head
  check({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 0.1);  // an L
  check({{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 0.05);  // a U
  Points star;
  for (int n = 0; n < 24; ++n)
    star.emplace_back((1 + n % 2) * std::cos(n * std::numbers::pi / 12),
                      (1 + n % 2) * std::sin(n * std::numbers::pi / 12), 0);
  check(star, 1e-3);
}

TEST(CutPolygon, AroundAHoleByABridge) {
  // The outline goes along a bridge to the hole, round it, and back: two corners are there twice.
  check({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}},
        1e-3);
}

TEST(CutPolygon, WithoutAreaItStaysWithoutArea) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint64_t work = 0;
  EXPECT_TRUE(cut_polygon(Points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}, triangles, work));
  EXPECT_EQ(triangles.size(), 3u) << "for the checks of the mesh to name";
}

TEST(CutPolygon, WorkGrowsWithConcaveCornersOnly) {
  Points circle;
  const int count = 4096;
  for (int n = 0; n < count; ++n)
    circle.emplace_back(std::cos(2 * n * std::numbers::pi / count), std::sin(2 * n * std::numbers::pi / count), 0);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint64_t work = 0;
  ASSERT_TRUE(cut_polygon(circle, triangles, work));
  EXPECT_LT(work, 50u * count) << "a pass or two for each halving";
}

}  // namespace
}  // namespace pelagos
