#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rigid/distance_field.hpp"
#include "shapes/primitive.hpp"

namespace pelagos {
namespace {

constexpr double kD = 0.1, kReach = 0.2;

Eigen::AlignedBox3d all() { return {Eigen::Vector3d::Constant(-1e6), Eigen::Vector3d::Constant(1e6)}; }

std::vector<std::shared_ptr<const SolidField>> fields_of(const TriangleMesh& mesh, MeshKind kind = MeshKind::kClosed,
                                                         const Eigen::AlignedBox3d& within = all()) {
  TaskPool pool(2);
  return make_distance_fields(pool, make_body_shape(mesh, kD, std::nullopt, kind), {kD, kReach, within});
}

std::optional<Float4> look(const SolidField& field, double x, double y, double z) {
  return field.at(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(kReach));
}

/// A floor of 2 x 2 m with a wall of 1 m height along x = 1: the inner edge of a quay.
TriangleMesh corner() {
  TriangleMesh mesh;
  mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {1, -1, 1}, {1, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  return mesh;
}

TEST(DistanceField, OfABoxIsExactAtItsFaces) {
  const auto fields = fields_of(make_mesh(BoxShape{{1.0, 0.8, 0.6}}));
  ASSERT_EQ(fields.size(), 1U);
  for (const double s : {-0.04, 0.0, 0.03, 0.11, 0.19}) {
    const auto found = look(*fields[0], 0.13, 0.4 + s, 0.04);
    ASSERT_TRUE(found) << s;
    EXPECT_NEAR(found->w, s, 1e-5);
    EXPECT_NEAR(found->y, 1.0, 1e-5);
  }
  EXPECT_FALSE(look(*fields[0], 0.0, 0.61, 0.0)) << "out of reach";
  EXPECT_FALSE(look(*fields[0], std::numeric_limits<double>::quiet_NaN(), 0.4, 0.0));
}

TEST(DistanceField, PointsAwayFromEdges) {
  const auto fields = fields_of(make_mesh(BoxShape{{1.0, 0.8, 0.6}}));
  const auto found = look(*fields[0], 0.5 + 0.07, 0.4 + 0.07, 0.02);
  ASSERT_TRUE(found);
  // The nodes' distances have a kink at the edge: a tenth of a cell.
  EXPECT_NEAR(found->w, 0.07 * std::sqrt(2.0), 0.1 * kD);
  EXPECT_NEAR(found->x, found->y, 0.05);
  EXPECT_NEAR(found->z, 0.0, 0.01);
}

TEST(DistanceField, OfABallStandsInsideByItsCurvature) {
  for (const double radius : {0.3, 0.5, 0.8}) {
    const auto fields = fields_of(make_mesh(SphereShape{radius}));
    ASSERT_EQ(fields.size(), 1U);
    const Eigen::Vector3d way = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
    for (const double s : {0.02, 0.08, 0.15}) {
      const Eigen::Vector3d x = (radius + s) * way;
      const auto found = look(*fields[0], x.x(), x.y(), x.z());
      ASSERT_TRUE(found) << radius << ' ' << s;
      const double inside = 0.075 * kD * kD * 2.0 / (radius + s);
      EXPECT_NEAR(found->w, s + inside, 0.02 * kD) << radius << ' ' << s;
      EXPECT_NEAR(Eigen::Vector3f(found->x, found->y, found->z).dot(way.cast<float>()), 1.0, 2e-3);
    }
  }
}

TEST(DistanceField, NormalsAreTheGradientOfTheDistance) {
  const auto fields = fields_of(make_mesh(SphereShape{0.4}));
  const Eigen::Vector3d x = 0.47 * Eigen::Vector3d(-0.2, 0.6, 0.5).normalized();
  const auto here = look(*fields[0], x.x(), x.y(), x.z());
  ASSERT_TRUE(here);
  constexpr double kStep = 1e-3;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d way = kStep * Eigen::Vector3d::Unit(axis), a = x - way, b = x + way;
    const double slope =
        static_cast<double>(look(*fields[0], b.x(), b.y(), b.z())->w - look(*fields[0], a.x(), a.y(), a.z())->w) /
        (2.0 * kStep);
    EXPECT_NEAR(slope, axis == 0 ? here->x : axis == 1 ? here->y : here->z, 0.01) << axis;
  }
}

TEST(DistanceField, AnInnerEdgeParts) {
  const auto fields = fields_of(corner(), MeshKind::kOpen);
  ASSERT_EQ(fields.size(), 2U) << "the floor and the wall";
  const auto floor = look(*fields[0], 0.9, 0.0, 0.05), wall = look(*fields[1], 0.9, 0.0, 0.05);
  ASSERT_TRUE(floor && wall);
  EXPECT_NEAR(floor->w, 0.05, 1e-5);
  EXPECT_NEAR(floor->z, 1.0, 1e-5);
  EXPECT_NEAR(wall->w, 0.1, 1e-5);
  EXPECT_NEAR(wall->x, -1.0, 1e-5);
}

TEST(DistanceField, OuterEdgesDoNotPart) {
  EXPECT_EQ(fields_of(make_mesh(BoxShape{{1, 1, 1}})).size(), 1U);
  EXPECT_EQ(fields_of(make_mesh(CylinderShape{0.3, 1.0})).size(), 1U);
}

TEST(DistanceField, IsMadeOnlyWhereItIsWanted) {
  const Eigen::AlignedBox3d half(Eigen::Vector3d(-2, -2, -2), Eigen::Vector3d(0, 2, 2));
  const auto fields = fields_of(make_mesh(BoxShape{{1, 1, 1}}), MeshKind::kClosed, half);
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_TRUE(look(*fields[0], -0.6, 0, 0));
  EXPECT_FALSE(look(*fields[0], 0.6, 0, 0));
  const Eigen::AlignedBox3d elsewhere(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
  EXPECT_TRUE(fields_of(make_mesh(BoxShape{{1, 1, 1}}), MeshKind::kClosed, elsewhere).empty());
}

TEST(DistanceField, HasABoundOfNodes) {
  // 1 km of box at 0.1 m: 8e12 nodes.
  TaskPool pool(1);
  BodyShape shape;
  shape.mesh = make_mesh(BoxShape{{1000, 1000, 1000}});
  shape.surface = std::make_shared<const MeshQuery>(shape.mesh);
  EXPECT_TRUE(make_distance_fields(pool, shape, {kD, kReach, all()}).empty());
}

TEST(DistanceField, ThinPlatesAreKnown) {
  EXPECT_DOUBLE_EQ(thin_share(make_body_shape(make_mesh(BoxShape{{1, 1, 0.05}}), kD, std::nullopt), 1.5 * kD),
                   2.0 / 2.2)
      << "the edges are as thick as the plate is long";
  EXPECT_EQ(thin_share(make_body_shape(make_mesh(BoxShape{{1, 1, 1}}), kD, std::nullopt), 1.5 * kD), 0.0);
  EXPECT_EQ(thin_share(make_body_shape(corner(), kD, std::nullopt, MeshKind::kOpen), 1.5 * kD), 0.0);
}

}  // namespace
}  // namespace pelagos
