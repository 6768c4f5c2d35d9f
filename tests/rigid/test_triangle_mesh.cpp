#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "../support/refusal_matcher.hpp"
#include "rigid/triangle_mesh.hpp"
#include "test_meshes.hpp"

namespace pelagos {
namespace {

using test::make_box;
using test::make_sphere;
using test::Says;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(TriangleMesh, BoxAndSphereAreSoundAndHaveTheirVolumes) {
  const auto box = make_box({-1, -2, -3}, {2, 2, 0.5});
  EXPECT_THAT(find_mesh_faults(box), IsEmpty());
  EXPECT_NEAR(mesh_volume(box), 3 * 4 * 3.5, 1e-12);  // rounding
  EXPECT_NEAR(mesh_area(box), 2 * (12 + 14 + 10.5), 1e-12);
  const auto sphere = make_sphere(2.0, 40);
  EXPECT_THAT(find_mesh_faults(sphere), IsEmpty());
  EXPECT_NEAR(mesh_volume(sphere), 4.0 / 3 * std::numbers::pi * 8, 0.005 * 33.5);  // inscribed: (pi/40)^2 / 2 too small
}

TEST(TriangleMesh, NamesAnOpenEdge) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles.erase(box.triangles.begin() + 4);
  const auto faults = find_mesh_faults(box);
  ASSERT_THAT(faults, SizeIs(4));  // the hole has three edges; and what to do
  EXPECT_THAT(faults, Contains(Says("open edge: only triangle")));
  EXPECT_THAT(faults, Contains(Says("(0, 0, 0) m")));
}

TEST(TriangleMesh, NamesAnInvertedTriangle) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  std::swap(box.triangles[7][0], box.triangles[7][1]);
  const auto faults = find_mesh_faults(box);
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_THAT(faults[0], Says("inverted triangle: triangle 8 at"));
}

TEST(TriangleMesh, NamesAShellInsideOut) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  for (auto& triangle : box.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(find_mesh_faults(box), Contains(Says("facing inwards")));
}

TEST(TriangleMesh, NamesDegenerateAndAbsurdInput) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles.push_back({0, 1, 1});
  EXPECT_THAT(find_mesh_faults(box), Contains(Says("triangle 13")));
  box = make_box({0, 0, 0}, {1, 1, 1});
  box.vertices[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(find_mesh_faults(box), Contains(Says("triangle 3 has a corner at (1, nan, 1) m")));
  box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles[0][2] = 99;
  EXPECT_THAT(find_mesh_faults(box), SizeIs(1));
  EXPECT_THAT(find_mesh_faults({}), SizeIs(1));
}

TEST(TriangleMesh, NamesTheSmallerPartThatFacesAgainstTheRest) {
  auto sphere = make_sphere(1.0, 8);
  for (std::size_t t = 20; t < 25; ++t) std::swap(sphere.triangles[t][1], sphere.triangles[t][2]);
  const auto faults = find_mesh_faults(sphere);
  ASSERT_THAT(faults, SizeIs(4));
  EXPECT_THAT(faults[0], Says("triangle 21"));
  EXPECT_THAT(faults[3], Says("2 more, 5 in all"));
}

TEST(TriangleMesh, NamesASurfaceOfOneSide) {
  TriangleMesh strip;  // five quadrangles round a ring, turned by half a turn
  for (int k = 0; k < 5; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 5.0;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d across =
        0.3 * (std::cos(0.5 * angle) * Eigen::Vector3d::UnitZ() + std::sin(0.5 * angle) * out);
    strip.vertices.push_back(out + across);
    strip.vertices.push_back(out - across);
  }
  for (std::uint32_t k = 0; k < 5; ++k) {
    const std::uint32_t a = 2 * k, b = a + 1, c = k < 4 ? a + 2 : 1, d = k < 4 ? a + 3 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({c, b, d});
  }
  EXPECT_THAT(find_mesh_faults(strip, MeshKind::kOpen), testing::ElementsAre(Says("single side")));
}

TEST(TriangleMesh, NamesAnEdgeOfThreeTriangles) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  box.vertices.emplace_back(0.5, -1.0, 0.0);
  box.triangles.push_back({0, 1, 8});
  EXPECT_THAT(find_mesh_faults(box), Contains(Says("3 triangles have the edge from (0, 0, 0) m to (1, 0, 0) m")));
}

TEST(TriangleMesh, AnOpenMeshMayEndAtARimButNotBeInverted) {
  auto bed = make_box({0, 0, 0}, {1, 1, 1});
  bed.triangles.resize(2);
  EXPECT_THAT(find_mesh_faults(bed, MeshKind::kOpen), IsEmpty());
  EXPECT_THAT(find_mesh_faults(bed), Contains(Says("open edge")));
  EXPECT_THAT(rim_edges(bed), SizeIs(4)) << "of a square, without its diagonal";
  EXPECT_THAT(rim_edges(make_box({0, 0, 0}, {1, 1, 1})), IsEmpty());
  std::swap(bed.triangles[1][0], bed.triangles[1][1]);
  EXPECT_THAT(find_mesh_faults(bed, MeshKind::kOpen), Contains(Says("inverted triangle")));
}

/// The triangles of several meshes, and the mesh that each came from.
TriangleMesh joined(const std::vector<TriangleMesh>& meshes, std::vector<std::uint32_t>& part) {
  TriangleMesh all;
  for (std::uint32_t number = 0; number < meshes.size(); ++number) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), meshes[number].vertices.begin(), meshes[number].vertices.end());
    for (const auto& [a, b, c] : meshes[number].triangles) all.triangles.push_back({first + a, first + b, first + c});
    part.resize(all.triangles.size(), number);
  }
  return all;
}

TEST(WeldParts, KeepsClosedPartsThatTouchApart) {
  std::vector<std::uint32_t> part;
  const TriangleMesh two = joined({make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 0, 0}, {2, 1, 1})}, part);
  EXPECT_EQ(weld_vertices(two, 1e-6).vertices.size(), 12u);
  const TriangleMesh welded = weld_parts(two, part, 1e-6);
  EXPECT_EQ(welded.vertices.size(), 16u);
  EXPECT_THAT(find_mesh_faults(welded), IsEmpty());
}

TEST(WeldParts, JoinsThePatchesOfOneHull) {
  TriangleMesh bottom = make_box({0, 0, 0}, {1, 1, 1}), rest = bottom;
  bottom.triangles.resize(2);
  rest.triangles.erase(rest.triangles.begin(), rest.triangles.begin() + 2);
  std::vector<std::uint32_t> part;
  const TriangleMesh buoy = make_box({0, 0, 1}, {1, 1, 2});  // stands on the hull, between the patches
  const TriangleMesh all = joined({bottom, buoy, rest}, part);
  const TriangleMesh welded = weld_parts(all, part, 1e-6);
  EXPECT_EQ(welded.vertices.size(), 16u);
  EXPECT_THAT(find_mesh_faults(welded), IsEmpty());
  EXPECT_NEAR(mesh_volume(welded), 2.0, 1e-12);
}

TEST(MeshOrigin, NamesTheTriangleAsItsFileDoes) {
  TriangleMesh box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles.pop_back();
  const MeshOrigin origin{
      {"object \"keel\""}, std::vector<std::uint32_t>(11, 0), {"face"}, std::vector<std::uint32_t>(11, 7)};
  EXPECT_THAT(find_mesh_faults(box, MeshKind::kClosed, origin), Contains(Says("face 7 of object \"keel\"")));
}

}  // namespace
}  // namespace pelagos
