#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "rigid/hydrostatics.hpp"
#include "rigid/triangle_mesh.hpp"
#include "shapes/primitive.hpp"

namespace pelagos {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Hydrostatics, BargeHasItsClosedForm) {
  const double length = 20.0, beam = 6.0, depth = 4.0, draft = 1.5;
  TriangleMesh barge = make_mesh(BoxShape{{length, beam, depth}});
  for (Eigen::Vector3d& vertex : barge.vertices) vertex += Eigen::Vector3d(100.0, 0.0, 0.5 * depth);  // keel at 0
  const Hydrostatics h = hydrostatics(barge, {Eigen::Vector3d::UnitZ(), draft});
  EXPECT_NEAR(h.volume, length * beam * draft, 1e-10);  // rounding, here and below
  EXPECT_NEAR((h.centre_of_buoyancy - Eigen::Vector3d(100.0, 0.0, 0.5 * draft)).norm(), 0.0, 1e-11);
  EXPECT_NEAR(h.waterplane_area, length * beam, 1e-10);
  EXPECT_NEAR((h.centre_of_flotation - Eigen::Vector3d(100.0, 0.0, draft)).norm(), 0.0, 1e-11);
  EXPECT_NEAR(h.wetted_area, length * beam + 2.0 * draft * (length + beam), 1e-10);
  EXPECT_NEAR(h.waterplane_moments(1, 1), length * std::pow(beam, 3) / 12.0, 1e-9);  // BM = this / volume
  EXPECT_NEAR(h.waterplane_moments(0, 0), beam * std::pow(length, 3) / 12.0, 1e-8);
}

TEST(Hydrostatics, HeeledBargeDisplacesAPrism) {
  // Turned by 45 degrees about its length, water up to the keel edge's height plus s: a triangle of height s, area s^2.
  const double length = 10.0, s = 1.0;
  const TriangleMesh barge = make_mesh(BoxShape{{length, 4.0, 4.0}});
  const Eigen::Vector3d up = Eigen::Vector3d(0.0, 1.0, 1.0).normalized();
  const Hydrostatics h = hydrostatics(barge, {up, -std::sqrt(8.0) + s});
  EXPECT_NEAR(h.volume, s * s * length, 1e-10);
  EXPECT_NEAR(up.dot(h.centre_of_buoyancy), -std::sqrt(8.0) + 2.0 / 3.0 * s, 1e-10);
  EXPECT_NEAR(h.waterplane_area, 2.0 * s * length, 1e-10);
}

TEST(Hydrostatics, SphereDisplacesACap) {
  // V = pi a^2 (3 r - a) / 3 and z = -3 (2 r - a)^2 / (4 (3 r - a)) for a cap of height a; the mesh differs by 0.3 %.
  const double r = 2.0;
  const TriangleMesh sphere = make_mesh(SphereShape{r});
  for (const double level : {-1.2, 0.0, 0.7}) {
    const double a = r + level, volume = kPi * a * a * (3.0 * r - a) / 3.0;
    const Hydrostatics h = hydrostatics(sphere, {Eigen::Vector3d::UnitZ(), level});
    EXPECT_NEAR(h.volume, volume, 3e-3 * volume) << level;
    EXPECT_NEAR(h.centre_of_buoyancy.z(), -3.0 * std::pow(2.0 * r - a, 2) / (4.0 * (3.0 * r - a)), 3e-3 * r) << level;
    EXPECT_NEAR(h.waterplane_area, kPi * (r * r - level * level), 5e-3 * kPi * r * r) << level;
  }
}

TEST(Hydrostatics, SideFloatingCylinderDisplacesASegment) {
  const double r = 1.0, length = 5.0, level = -0.4, angle = 2.0 * std::acos(-level / r);
  const Hydrostatics h = hydrostatics(make_mesh(CylinderShape{r, length}), {Eigen::Vector3d::UnitX(), level});
  const double volume = 0.5 * r * r * (angle - std::sin(angle)) * length;
  EXPECT_NEAR(h.volume, volume, 5e-3 * volume);  // polygon of 64 sides
  EXPECT_NEAR(h.waterplane_area, 2.0 * r * std::sin(0.5 * angle) * length, 5e-3 * 2.0 * r * length);
}

TEST(Hydrostatics, DryAndSunkBodies) {
  const TriangleMesh box = make_mesh(BoxShape{{1.0, 2.0, 3.0}});
  const Hydrostatics dry = hydrostatics(box, {Eigen::Vector3d::UnitZ(), -1.5});
  EXPECT_EQ(dry.volume, 0.0);
  EXPECT_EQ(dry.waterplane_area, 0.0);
  EXPECT_EQ(dry.wetted_area, 0.0);
  const Hydrostatics sunk = hydrostatics(box, {Eigen::Vector3d(1, 1, 1).normalized(), 50.0});
  EXPECT_NEAR(sunk.volume, 6.0, 1e-12);
  EXPECT_NEAR(sunk.centre_of_buoyancy.norm(), 0.0, 1e-10);
  EXPECT_EQ(sunk.waterplane_area, 0.0);
  EXPECT_NEAR(sunk.wetted_area, mesh_area(box), 1e-12);
  EXPECT_EQ(hydrostatics({}, {}).volume, 0.0);
}

}  // namespace
}  // namespace pelagos
