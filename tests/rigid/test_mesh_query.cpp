#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../support/places.hpp"
#include "rigid/mesh_query.hpp"
#include "test_meshes.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

using test::make_box;
using test::make_sphere;

TEST(MeshQuery, AgreesWithTheSphere) {
  const double radius = 2.0;
  const MeshQuery query(make_sphere(radius, 60));
  SplitMix64 random(3);
  for (int n = 0; n < 1000; ++n) {
    const Eigen::Vector3d point(5 * random.next_unit() - 2.5, 5 * random.next_unit() - 2.5,
                                5 * random.next_unit() - 2.5);
    const double depth = radius - point.norm();
    // the facets lie up to r (1 - cos(pi/60 * 0.71)) = 0.003 inside the sphere
    if (std::abs(depth) > 0.004) {
      EXPECT_EQ(query.inside(point), depth > 0) << point.transpose();
    }
    EXPECT_NEAR(query.distance(point, 100.0), std::abs(depth), 0.004);
    EXPECT_LE(query.distance(point, 0.1), 0.1);
  }
}

TEST(MeshQuery, InsideHoldsAtCornersAndEdgesOfTheLattice) {
  // Points whose rays along axes would run through edges and vertices.
  const MeshQuery query(make_box({-1, -1, -1}, {1, 1, 1}));
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = -4; k <= 4; ++k) {
        const Eigen::Vector3d point = 0.5 * Eigen::Vector3d(i, j, k);
        const double largest = point.cwiseAbs().maxCoeff();
        if (largest != 1.0) {
          EXPECT_EQ(query.inside(point), largest < 1.0) << point.transpose();
        }
      }
}

TEST(MeshQuery, RaysMeasureThickness) {
  const MeshQuery query(make_box({0, 0, 0}, {1, 2, 3}));
  EXPECT_NEAR(query.first_hit({0.3, 0.4, 0}, {0, 0, 1}, 1e-9), 3.0, 1e-12);
  EXPECT_NEAR(query.first_hit({-1, 0.4, 1}, {1, 0, 0}, 0), 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(query.first_hit({-1, 0.4, 1}, {-1, 0, 0}, 0)));
}

TEST(MeshQuery, TheUnionOfShellsThatOverlapIsInside) {
  TriangleMesh two = make_box({0, 0, 0}, {2, 1, 1});
  const TriangleMesh other = make_box({1, 0.2, 0.2}, {3, 0.8, 0.8});
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  const MeshQuery query(two);
  EXPECT_TRUE(query.inside({0.5, 0.5, 0.5}));
  EXPECT_TRUE(query.inside({1.5, 0.5, 0.5})) << "in both";
  EXPECT_TRUE(query.inside({2.5, 0.5, 0.5}));
  EXPECT_FALSE(query.inside({2.5, 0.1, 0.5}));
  // the face x = 2 of the first box and four sides of the second: two triangles each, those whose edges cross
  const SelfIntersections found = query.find_self_intersections();
  EXPECT_GT(found.pairs, 0u);
  EXPECT_LT(found.first[0], 12u);
  EXPECT_GE(found.first[1], 12u);
  EXPECT_TRUE(found.all);
  std::vector<std::uint32_t> part(24, 0);
  std::fill(part.begin() + 12, part.end(), 1u);
  EXPECT_EQ(query.find_self_intersections(part).pairs, 0u) << "two parts that cut each other do not cut themselves";
}

TEST(MeshQuery, FindsNoIntersectionInSoundMeshes) {
  EXPECT_EQ(MeshQuery(make_box({0, 0, 0}, {1, 2, 3})).find_self_intersections().pairs, 0u);
  EXPECT_EQ(MeshQuery(make_sphere(2.0, 30)).find_self_intersections().pairs, 0u);
  for (const char* hull : {"coaster_hull", "tanker_hull", "lighthouse_hull"}) {  // with faces in one plane side by side
    const MeshFile file = read_mesh(test::source_path("assets/meshes/") + hull + ".obj");
    ASSERT_TRUE(file.faults.empty()) << file.faults.front();
    EXPECT_EQ(MeshQuery(file.mesh).find_self_intersections().pairs, 0u) << hull;
  }
}

TEST(MeshQuery, BehindIsTheInsideOfAClosedMesh) {
  const MeshQuery box(make_box({-1, -1, -1}, {1, 1, 1})), sphere(make_sphere(1.0, 12));
  SplitMix64 random(7);
  for (int n = 0; n < 2000; ++n) {
    const Eigen::Vector3d point(4 * random.next_unit() - 2, 4 * random.next_unit() - 2, 4 * random.next_unit() - 2);
    EXPECT_EQ(box.behind(point), box.inside(point)) << point.transpose();  // near edges and corners too
    EXPECT_EQ(sphere.behind(point), sphere.inside(point)) << point.transpose();
  }
}

}  // namespace
}  // namespace pelagos
