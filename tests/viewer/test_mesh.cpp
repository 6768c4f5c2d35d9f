#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "../support/places.hpp"
#include "meshes/body_mesh.hpp"
#include "meshes/mesh_loader.hpp"
#include "meshes/tank.hpp"
#include "shapes/file_digest.hpp"

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

MeshData mesh_of(const char* name) { return load_body_mesh(kMeshes, {1, "", name, 1.0}).data; }

TEST(CoasterMesh, IsDrawnInPlaceOfItsHull) {
  EXPECT_EQ(outfitted_file(kMeshes / "coaster_hull.obj"), kMeshes / "coaster.obj");
  EXPECT_EQ(outfitted_file(kMeshes / "coaster.obj"), kMeshes / "coaster.obj");
  EXPECT_EQ(outfitted_file(kMeshes / "no_such_hull.obj"), kMeshes / "no_such_hull.obj");
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
  const MeshData box = mesh_of("primitive:box:2x1x0.5");
  EXPECT_EQ(box.indices.size(), 36u);
  EXPECT_EQ(box.low, Eigen::Vector3f(-1.0F, -0.5F, -0.25F));
  EXPECT_EQ(box.high, Eigen::Vector3f(1.0F, 0.5F, 0.25F));
  for (const auto& v : box.vertices)  // flat faces: each normal along one axis
    EXPECT_NEAR(std::max({std::abs(v.normal[0]), std::abs(v.normal[1]), std::abs(v.normal[2])}), 1.0F, 1e-6F);
  const MeshData ball = mesh_of("primitive:sphere:2");
  for (const auto& v : ball.vertices) {  // smooth: normals along the radius, within half a facet (2.8 degrees)
    const Eigen::Vector3f n(v.normal), p(v.position);
    EXPECT_GT(n.dot(p.normalized()), 0.9985F);
  }
}

TEST(BodyMesh, LargePrimitivesAreOfConcreteSmallOnesYellow) {
  const auto redness = [](const char* name) {
    const MeshData body = mesh_of(name);
    const auto& colour = body.vertices.at(0).colour;
    return colour[0] / colour[2];
  };
  EXPECT_GT(redness("primitive:box:2x1x0.5"), 5.0F);
  EXPECT_LT(redness("primitive:box:78x3x8"), 1.5F);
}

TEST(BodyMesh, TurnsFilesThatAreYUp) {
  const MeshData as_is = mesh_of("coaster_hull.obj");
  const MeshData turned = mesh_of("y-up:coaster_hull.obj");
  EXPECT_EQ(turned.high, Eigen::Vector3f(as_is.high.z(), as_is.high.x(), as_is.high.y()));
  EXPECT_EQ(turned.low, Eigen::Vector3f(as_is.low.z(), as_is.low.x(), as_is.low.y()));
}

TEST(BodyMesh, SaysWhatIsMissing) {
  EXPECT_THROW((void)mesh_of("ghost.obj"), MeshError);
  EXPECT_THROW((void)mesh_of("primitive:sphere:-1"), MeshError);
}

TEST(Mesh, RefusesWhatItCannotRead) {
  EXPECT_THROW((void)load_mesh(kMeshes / "none.obj", 1.0), MeshError);
  const std::filesystem::path empty = std::filesystem::path(testing::TempDir()) / "empty.obj";
  std::ofstream(empty) << "# nothing\n";
  EXPECT_THROW((void)load_mesh(empty, 1.0), MeshError);
  std::filesystem::remove(empty);
}

/// A folder for meshes, empty at first.
class MeshFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A tetrahedron with legs of that length.
  static std::string tetrahedron(double length) {
    std::ostringstream text;
    text << "v 0 0 0\nv " << length << " 0 0\nv 0 " << length << " 0\nv 0 0 " << length
         << "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    return text.str();
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::shared_ptr<BodySurface> surface_of(const std::string& name, float length) const {
    auto surface = std::make_shared<BodySurface>();
    surface->file_digest = file_digest(folder_ / name);
    surface->high.setConstant(static_cast<double>(length));
    surface->vertices = {{0, 0, 0}, {length, 0, 0}, {0, length, 0}, {0, 0, length}};
    surface->triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    surface->triangle_count = 4;
    return surface;
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("meshes_" + std::to_string(getpid())) / "inner";
};

TEST_F(MeshFolder, TheServersFileIsDrawnAsItIs) {
  write("ferry.obj", tetrahedron(4));
  const BodyMesh mesh = load_body_mesh(folder_, {1, "", "ferry.obj", 1.0, surface_of("ferry.obj", 4)});
  EXPECT_EQ(mesh.note, "");
  EXPECT_EQ(mesh.data.high.x(), 4.0F);
}

TEST_F(MeshFolder, AFileOfTheSameNameThatIsAnotherIsNotDrawn) {
  write("ferry.obj", tetrahedron(4));
  const auto surface = surface_of("ferry.obj", 4);
  write("ferry.obj", tetrahedron(64));
  write("ferry_hull.obj", tetrahedron(64));
  for (const char* name : {"ferry.obj", "ferry_hull.obj"}) {
    const BodyMesh mesh = load_body_mesh(folder_, {1, "", name, 1.0, surface});
    EXPECT_EQ(mesh.data.high.x(), 4.0F) << "the server's";
    EXPECT_EQ(mesh.data.triangle_count(), 4U);
    EXPECT_NE(mesh.note.find((folder_ / name).string()), std::string::npos) << mesh.note;
    EXPECT_NE(mesh.note.find("64 x 64 x 64 m, the server's 4 x 4 x 4 m"), std::string::npos) << mesh.note;
  }
}

TEST_F(MeshFolder, TheOutfittedShipNeedsTheServersHullBesideIt) {
  write("ferry.obj", tetrahedron(70));
  write("ferry_hull.obj", tetrahedron(64));
  const auto surface = surface_of("ferry_hull.obj", 64);
  EXPECT_EQ(load_body_mesh(folder_, {1, "", "ferry_hull.obj", 1.0, surface}).data.high.x(), 70.0F);
  std::filesystem::remove(folder_ / "ferry_hull.obj");
  EXPECT_EQ(load_body_mesh(folder_, {1, "", "ferry_hull.obj", 1.0, surface}).data.high.x(), 64.0F);
}

TEST_F(MeshFolder, WithoutTheFileTheServersShapeIsDrawnOrABox) {
  auto surface = surface_of("none.obj", 4);
  const BodyInfo body{1, "", "none.obj", 1.0, surface};
  BodyMesh mesh = load_body_mesh(folder_, body);
  EXPECT_EQ(mesh.data.triangle_count(), 4U);
  EXPECT_NE(mesh.note.find("there is no mesh none.obj in " + folder_.string()), std::string::npos) << mesh.note;
  surface->vertices.clear();
  surface->triangles.clear();
  surface->triangle_count = 700'000;
  mesh = load_body_mesh(folder_, body);
  EXPECT_EQ(mesh.data.triangle_count(), 12U);
  EXPECT_EQ(mesh.data.low, Eigen::Vector3f::Zero());
  EXPECT_EQ(mesh.data.high, Eigen::Vector3f(4, 4, 4));
  EXPECT_NE(mesh.note.find("700000 triangles are too many to be sent"), std::string::npos) << mesh.note;
}

TEST_F(MeshFolder, NoNameLeadsOutOfTheFolder) {
  std::ofstream(folder_.parent_path() / "secret.obj") << tetrahedron(1);
  std::filesystem::create_symlink(folder_.parent_path() / "secret.obj", folder_ / "linked.obj");
  std::filesystem::create_directory(folder_ / "folder.obj");
  write("real.obj", tetrahedron(1));
  std::filesystem::create_symlink("real.obj", folder_ / "other.obj");
  for (const std::string& name :
       {std::string("../secret.obj"), std::string(".."), std::string("."), std::string(), std::string("linked.obj"),
        std::string("folder.obj"), (folder_.parent_path() / "secret.obj").string(), std::string(256, 'a'),
        std::string(100'000, 'b'), std::string("\x1b]0;x\x07.obj"), std::string("/dev/zero")})
    EXPECT_TRUE(find_mesh_file(folder_, name).empty()) << name.substr(0, 40);
  EXPECT_EQ(find_mesh_file(folder_, "real.obj"), folder_ / "real.obj");
  EXPECT_EQ(find_mesh_file(folder_, "other.obj"), folder_ / "other.obj") << "a link within";
  EXPECT_EQ(find_mesh_file(folder_, "/elsewhere/real.obj"), folder_ / "real.obj") << "folders are cut off";
  try {
    (void)load_body_mesh(folder_, {1, "", "a\x1b[31m.obj", 1.0});
    ADD_FAILURE() << "there is no such file";
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("a\\x1b[31m.obj"), std::string::npos) << error.what();
  }
}

TEST_F(MeshFolder, MaterialsFromOutsideAreNotRead) {
  std::ofstream(folder_.parent_path() / "paint.mtl") << "newmtl red\nKd 1 0 0\n";
  write("boat.obj", "mtllib ../paint.mtl\nusemtl red\n" + tetrahedron(1));
  const MeshData mesh = load_mesh(folder_ / "boat.obj", 1.0);
  EXPECT_EQ(mesh.vertices.at(0).colour[0], mesh.vertices.at(0).colour[1]) << "grey";
}

/// Waits until all that is wanted has been read.
void wait_for(const MeshLoader& loader) {
  for (int i = 0; i < 4000 && !loader.done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(loader.done());
}

TEST_F(MeshFolder, BodiesWithTheSameMeshShareIt) {
  write("buoy.obj", tetrahedron(1));
  MeshLoader loader(folder_);
  std::vector<BodyInfo> bodies;
  for (std::uint32_t id = 1; id <= 64; ++id)
    bodies.push_back({id, "", "buoy.obj", 1.0, surface_of("buoy.obj", 1)});  // each has a surface of its own
  loader.want(bodies);
  wait_for(loader);
  BodyMeshes meshes = loader.meshes();
  ASSERT_EQ(meshes.size(), 64U);
  for (const auto& [body, mesh] : meshes) EXPECT_EQ(mesh, meshes.begin()->second);
  const auto first = meshes.at(1);
  bodies[0].mesh_scale = 2.0;
  loader.want(bodies);
  wait_for(loader);
  meshes = loader.meshes();
  EXPECT_NE(meshes.at(1), first);
  EXPECT_EQ(meshes.at(2), first) << "read before, not again";
  loader.want({});
  EXPECT_TRUE(loader.meshes().empty());
  EXPECT_TRUE(loader.done());
}

TEST_F(MeshFolder, AMeshThatIsMissingHoldsNobodyUp) {
  write("buoy.obj", tetrahedron(1));
  MeshLoader loader(folder_);
  loader.want({{1, "", "ghost.obj", 1.0}, {2, "", "buoy.obj", 1.0, surface_of("buoy.obj", 1)}});
  wait_for(loader);
  EXPECT_FALSE(loader.meshes().contains(1));
  EXPECT_TRUE(loader.meshes().contains(2));
  const std::vector<std::string> notes = loader.take_notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("body 1: there is no mesh ghost.obj"), std::string::npos) << notes[0];
  EXPECT_TRUE(loader.take_notes().empty());
}

TEST_F(MeshFolder, TrianglesOfAllBodiesTogetherAreBounded) {
  auto surface = surface_of("none.obj", 4);
  surface->triangles.resize(BodySurface::kMostTriangles, {0, 2, 1});
  MeshLoader loader(folder_);
  std::vector<BodyInfo> bodies;
  for (std::uint32_t id = 1; id <= 30; ++id) bodies.push_back({id, "", "none.obj", 1.0, surface});
  loader.want(bodies);
  wait_for(loader);
  std::size_t drawn = 0;
  for (const auto& [body, mesh] : loader.meshes()) drawn += mesh->triangle_count();
  EXPECT_LE(drawn, MeshLoader::kMostTriangles + 30 * 12);
  EXPECT_GE(drawn, MeshLoader::kMostTriangles / 2);
}

TEST(FileDigest, IsThatOfTheBytes) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / ("digest_" + std::to_string(getpid()));
  std::ofstream(file) << "foobar";
  EXPECT_EQ(file_digest(file), 0x85944171f73967e8ull) << "a published value of FNV-1a";
  std::filesystem::remove(file);
  EXPECT_EQ(file_digest(file), 0U);
  EXPECT_EQ(file_digest("/dev/zero"), 0U);
  EXPECT_EQ(file_digest(testing::TempDir()), 0U);
}

TEST(Mesh, DrawsALongBoxAsAQuay) {
  const MeshData quay = draw_primitive(BoxShape{{60, 8, 9}}), buoy = draw_primitive(BoxShape{{2, 2, 2}});
  EXPECT_EQ(buoy.triangle_count(), 12U);
  EXPECT_GT(quay.triangle_count(), 500U);
  EXPECT_NEAR(quay.high.x(), 30.0, 0.02) << "half a joint";
  EXPECT_NEAR(quay.high.y(), 4.33, 1e-4) << "fenders";
  EXPECT_NEAR(quay.low.z(), -4.5, 1e-4);
  EXPECT_LT(quay.high.z(), 4.5 + 0.7) << "bollards";
  const MeshData turned = draw_primitive(BoxShape{{8, 60, 9}});
  EXPECT_EQ(turned.triangle_count(), quay.triangle_count());
  EXPECT_NEAR(turned.high.y(), 30.0, 0.02);
  EXPECT_LT(draw_primitive(BoxShape{{50'000, 8, 9}}).triangle_count(), 40'000U) << "bounded";
  for (const MeshData::Vertex& vertex : turned.vertices) {  // turned, not mirrored: normals look outwards
    if (vertex.position[1] > 29.99F && vertex.normal[1] != 0.0F) {
      EXPECT_GT(vertex.normal[1], -1e-3F);
    }
  }
}

TEST(Mesh, DrawsATankBySize) {
  const auto rises_inside = [](const MeshData& mesh, const Eigen::Vector3d& size) {
    for (const MeshData::Vertex& v : mesh.vertices)
      if (v.position[2] > 1e-4F && v.position[0] > 1e-4F && static_cast<double>(v.position[0]) < size.x() - 1e-4 &&
          v.position[1] > 1e-4F && static_cast<double>(v.position[1]) < size.y() - 1e-4)
        return true;
    return false;
  };
  const Eigen::Vector3d small(5, 3, 2), large(60, 30, 8);
  EXPECT_TRUE(has_glass_walls(small));
  EXPECT_FALSE(has_glass_walls(large));
  const MeshData glass = draw_tank(small, 1.5), concrete = draw_tank(large, 6.5);
  EXPECT_NEAR(glass.high.z(), 2.0, 1e-6) << "the frame goes up to the top";
  EXPECT_NEAR(concrete.high.z(), 6.5, 1e-6);
  EXPECT_FALSE(rises_inside(glass, small)) << "nothing stands where the water is";
  EXPECT_FALSE(rises_inside(concrete, large));
  EXPECT_LT(draw_tank({5, 1e5, 2}, 1).triangle_count(), 10'000U);
}

}  // namespace
}  // namespace pelagos
