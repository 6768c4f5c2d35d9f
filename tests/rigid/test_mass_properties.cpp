#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "rigid/mass_properties.hpp"
#include "shapes/primitive.hpp"

namespace pelagos {
namespace {

TriangleMesh moved(TriangleMesh mesh, const Eigen::Quaterniond& turn, const Eigen::Vector3d& shift) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = turn * vertex + shift;
  return mesh;
}

TEST(MassProperties, BoxHasItsClosedForm) {
  const Eigen::Vector3d size(3.0, 2.0, 0.5), shift(10.0, -20.0, 5.0);
  const auto box = mass_properties(moved(make_mesh(BoxShape{size}), Eigen::Quaterniond::Identity(), shift));
  EXPECT_NEAR(box.volume, 3.0, 1e-12);  // rounding, here and below
  EXPECT_NEAR((box.centre - shift).norm(), 0.0, 1e-12);
  const Eigen::Vector3d squares = size.cwiseAbs2();
  const Eigen::Vector3d expected = 3.0 / 12.0 * (squares.sum() * Eigen::Vector3d::Ones() - squares);
  EXPECT_NEAR((box.inertia - Eigen::Matrix3d(expected.asDiagonal())).norm(), 0.0, 1e-11);
}

TEST(MassProperties, RoundBodiesHaveTheirClosedForms) {
  // The meshes have the exact volume; polygons of 64 sides and rings of 16 change moments of inertia by less than 0.3
  // %.
  const double r = 1.5, sphere_mass = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const auto sphere = mass_properties(make_mesh(SphereShape{r}));
  EXPECT_NEAR(sphere.volume, sphere_mass, 1e-12);
  const Eigen::Matrix3d expected = 0.4 * sphere_mass * r * r * Eigen::Matrix3d::Identity();
  EXPECT_LT((sphere.inertia - expected).norm(), 3e-3 * expected.norm());

  const double radius = 0.5, length = 4.0, mass = std::numbers::pi * radius * radius * length;
  const auto cylinder = mass_properties(make_mesh(CylinderShape{radius, length}));
  EXPECT_NEAR(cylinder.centre.norm(), 0.0, 1e-12);
  EXPECT_NEAR(cylinder.inertia(2, 2), 0.5 * mass * radius * radius, 3e-3 * cylinder.inertia(2, 2));
  EXPECT_NEAR(cylinder.inertia(0, 0), mass * (3.0 * radius * radius + length * length) / 12.0,
              3e-3 * cylinder.inertia(0, 0));
  EXPECT_NEAR(cylinder.inertia(0, 1), 0.0, 1e-12);
}

TEST(MassProperties, InertiaTurnsWithTheBody) {
  const TriangleMesh mesh = make_mesh(BoxShape{{3.0, 2.0, 0.5}});
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto straight = mass_properties(mesh), turned = mass_properties(moved(mesh, turn, {100.0, 0.0, -50.0}));
  const Eigen::Matrix3d rotation = turn.toRotationMatrix();
  const Eigen::Matrix3d expected = rotation * straight.inertia * rotation.transpose();
  EXPECT_NEAR((turned.inertia - expected).norm(), 0.0, 1e-10);
}

}  // namespace
}  // namespace pelagos
