#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "rigid/triangle_mesh.hpp"
#include "shapes/mesh_name.hpp"
#include "shapes/primitive.hpp"

namespace pelagos {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Primitive, MeshesAreClosedAndEncloseTheVolumeOfTheShape) {
  const std::pair<Primitive, double> shapes[] = {{BoxShape{{2.0, 1.0, 0.5}}, 1.0},
                                                 {SphereShape{1.5}, 4.0 / 3.0 * kPi * 3.375},
                                                 {CylinderShape{0.5, 4.0}, kPi},
                                                 {CapsuleShape{0.5, 4.0}, kPi * 0.25 * (4.0 - 1.0 / 3.0)},
                                                 {CapsuleShape{0.5, 1.0}, 4.0 / 3.0 * kPi * 0.125}};
  for (const auto& [shape, volume] : shapes) {
    const TriangleMesh mesh = make_mesh(shape);
    const auto faults = find_mesh_faults(mesh);
    EXPECT_TRUE(faults.empty()) << name_of(shape) << ": " << faults.front();
    EXPECT_NEAR(volume_of(shape), volume, 1e-12 * volume) << name_of(shape);  // rounding
    EXPECT_NEAR(mesh_volume(mesh), volume, 1e-12 * volume) << name_of(shape);
  }
}

TEST(Primitive, RoundMeshesStayWithinAThousandthsOfTheirShape) {
  for (const Eigen::Vector3d& v : make_mesh(SphereShape{2.0}).vertices) EXPECT_NEAR(v.norm(), 2.0, 0.005);
  for (const Eigen::Vector3d& v : make_mesh(CylinderShape{2.0, 6.0}).vertices) {
    EXPECT_DOUBLE_EQ(std::abs(v.z()), 3.0);
    if (v.head<2>().norm() > 0.0) {
      // regular polygon of 64 sides with a circle's area: sqrt(x / sin x), x = 2 pi / 64: 1.0008
      EXPECT_NEAR(v.head<2>().norm(), 2.0 * 1.0008, 1e-3);
    }
  }
}

TEST(Primitive, NamesReadBackToTheSameBits) {
  const Primitive shapes[] = {BoxShape{{2.0, 1.0 / 3.0, 1e-3}}, SphereShape{0.1}, CylinderShape{0.5, 4.0},
                              CapsuleShape{0.7, 1.4}};
  for (const Primitive& shape : shapes) {
    const auto read = parse_primitive(name_of(shape));
    ASSERT_TRUE(read) << name_of(shape);
    EXPECT_EQ(name_of(*read), name_of(shape));
    EXPECT_EQ(volume_of(*read), volume_of(shape));
  }
  EXPECT_EQ(name_of(BoxShape{{2.0, 1.0, 0.5}}), "primitive:box:2x1x0.5");
}

TEST(Primitive, RefusesNamesThatAreNone) {
  for (const char* name :
       {"", "hull.obj", "primitive:", "primitive:box", "primitive:box:", "primitive:box:1x2", "primitive:box:1x2x3x4",
        "primitive:box:1x2x", "primitive:box:1x2x3 ", "primitive:box:1x-2x3", "primitive:box:1x0x3",
        "primitive:sphere:nan", "primitive:sphere:inf", "primitive:sphere:1e7", "primitive:sphere:1x2",
        "primitive:cylinder:1", "primitive:capsule:1x1.9", "primitive:cone:1x2", "PRIMITIVE:sphere:1"})
    EXPECT_FALSE(parse_primitive(name)) << name;
}

TEST(MeshName, CarriesAxesAndPrimitivesOverTheWire) {
  MeshName file;
  file.file = "hull.glb";
  EXPECT_EQ(wire_name(file), "hull.glb");
  file.axes = MeshAxes::kZForwardYUp;
  EXPECT_EQ(wire_name(file), "y-up:hull.glb");
  EXPECT_EQ(parse_wire_name("y-up:hull.glb").axes, MeshAxes::kZForwardYUp);
  EXPECT_EQ(parse_wire_name("y-up:hull.glb").file, "hull.glb");
  EXPECT_EQ(parse_wire_name("y-up:../../etc/passwd").file, "passwd") << "no way out of the folder of meshes";
  EXPECT_EQ(parse_wire_name("/far/away/hull.obj").file, "hull.obj");
  EXPECT_TRUE(parse_wire_name("primitive:sphere:2").primitive.has_value());
  EXPECT_FALSE(parse_wire_name("primitive:sphere:-2").primitive.has_value());
  EXPECT_TRUE(is_reserved("primitive:x") && is_reserved("y-up:hull.obj") && !is_reserved("hull.obj"));
}

TEST(MeshName, TurnsGltfAxesIntoTheBodys) {
  const Eigen::Matrix3d turn = body_from_file(MeshAxes::kZForwardYUp);
  EXPECT_EQ(turn * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()) << "forward";
  EXPECT_EQ(turn * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()) << "port";
  EXPECT_EQ(turn * Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()) << "up";
  EXPECT_EQ(body_from_file(MeshAxes::kXForwardZUp), Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace pelagos
