#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "../support/places.hpp"
#include "renderer/mesh.hpp"

namespace pelagos {
namespace {

const std::filesystem::path kMeshes = test::source_path("assets/meshes");

struct ObjText {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;
};

ObjText read_obj(const std::filesystem::path& file) {
  ObjText obj;
  std::ifstream in(file);
  std::string line, word;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      auto& v = obj.vertices.emplace_back();
      words >> v[0] >> v[1] >> v[2];
    } else if (word == "f") {
      auto& t = obj.triangles.emplace_back();
      words >> t[0] >> t[1] >> t[2];
    }
  }
  return obj;
}

TEST(CoasterHull, IsClosedAndFacesOutward) {
  const ObjText hull = read_obj(kMeshes / "coaster_hull.obj");
  ASSERT_GT(hull.triangles.size(), 1000u);
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  double volume = 0.0;
  for (const auto& t : hull.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    const auto &a = hull.vertices[t[0] - 1], &b = hull.vertices[t[1] - 1], &c = hull.vertices[t[2] - 1];
    volume +=
        (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6.0;
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  // between half of the box about it and the whole: positive means outward
  EXPECT_GT(volume, 0.5 * 36 * 9 * 5);
  EXPECT_LT(volume, 36 * 9 * 6.5);
}

TEST(CoasterMesh, IsDrawnInPlaceOfItsHull) {
  EXPECT_EQ(drawn_mesh_file(kMeshes, "coaster_hull.obj"), kMeshes / "coaster.obj");
  EXPECT_EQ(drawn_mesh_file(kMeshes, "/elsewhere/on/the/server/coaster_hull.obj"), kMeshes / "coaster.obj");
  EXPECT_EQ(drawn_mesh_file(kMeshes, "coaster.obj"), kMeshes / "coaster.obj");
  EXPECT_TRUE(drawn_mesh_file(kMeshes, "no_such_hull.obj").empty());
  EXPECT_TRUE(drawn_mesh_file(kMeshes, "").empty());
}

TEST(CoasterMesh, HasItsSizeAndColours) {
  const MeshData ship = load_mesh(kMeshes / "coaster.obj", 1.0);
  EXPECT_NEAR(ship.high.x() - ship.low.x(), 36.0F, 0.2F);
  EXPECT_NEAR(ship.high.y() - ship.low.y(), 9.2F, 0.2F) << "bridge wings stand out by 0.1 m";
  EXPECT_NEAR(ship.low.z(), -2.8F, 0.01F);
  std::map<std::array<float, 3>, int> colours;
  for (const auto& v : ship.vertices) ++colours[{v.colour[0], v.colour[1], v.colour[2]}];
  EXPECT_GE(colours.size(), 10u);
  const MeshData half = load_mesh(kMeshes / "coaster.obj", 0.5);
  EXPECT_NEAR(half.high.x(), 0.5F * ship.high.x(), 1e-5F);
}

TEST(BodyMesh, DrawsPrimitivesByTheirNames) {
  const MeshData box = load_body_mesh(kMeshes, "primitive:box:2x1x0.5", 1.0);
  EXPECT_EQ(box.indices.size(), 36u);
  EXPECT_EQ(box.low, Eigen::Vector3f(-1.0F, -0.5F, -0.25F));
  EXPECT_EQ(box.high, Eigen::Vector3f(1.0F, 0.5F, 0.25F));
  for (const auto& v : box.vertices)  // flat faces: each normal along one axis
    EXPECT_NEAR(std::max({std::abs(v.normal[0]), std::abs(v.normal[1]), std::abs(v.normal[2])}), 1.0F, 1e-6F);
  const MeshData ball = load_body_mesh(kMeshes, "primitive:sphere:2", 1.0);
  for (const auto& v : ball.vertices) {  // smooth: normals along the radius, within half a facet (2.8 degrees)
    const Eigen::Vector3f n(v.normal), p(v.position);
    EXPECT_GT(n.dot(p.normalized()), 0.9985F);
  }
}

TEST(BodyMesh, LargePrimitivesAreOfConcreteSmallOnesYellow) {
  const auto redness = [](const char* name) {
    const MeshData body = load_body_mesh(kMeshes, name, 1.0);
    const auto& colour = body.vertices.at(0).colour;
    return colour[0] / colour[2];
  };
  EXPECT_GT(redness("primitive:box:2x1x0.5"), 5.0F);
  EXPECT_LT(redness("primitive:box:78x3x8"), 1.5F);
}

TEST(BodyMesh, TurnsFilesThatAreYUp) {
  const MeshData as_is = load_body_mesh(kMeshes, "coaster_hull.obj", 1.0);
  const MeshData turned = load_body_mesh(kMeshes, "y-up:coaster_hull.obj", 1.0);
  EXPECT_EQ(turned.high, Eigen::Vector3f(as_is.high.z(), as_is.high.x(), as_is.high.y()));
  EXPECT_EQ(turned.low, Eigen::Vector3f(as_is.low.z(), as_is.low.x(), as_is.low.y()));
}

TEST(BodyMesh, SaysWhatIsMissing) {
  EXPECT_THROW((void)load_body_mesh(kMeshes, "ghost.obj", 1.0), GraphicsError);
  EXPECT_THROW((void)load_body_mesh(kMeshes, "primitive:sphere:-1", 1.0), GraphicsError);
}

TEST(Mesh, RefusesWhatItCannotRead) {
  EXPECT_THROW((void)load_mesh(kMeshes / "none.obj", 1.0), GraphicsError);
  const std::filesystem::path empty = std::filesystem::path(testing::TempDir()) / "empty.obj";
  std::ofstream(empty) << "# nothing\n";
  EXPECT_THROW((void)load_mesh(empty, 1.0), GraphicsError);
  std::filesystem::remove(empty);
}

}  // namespace
}  // namespace pelagos
