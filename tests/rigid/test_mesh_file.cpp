#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "../support/refusal_matcher.hpp"
#include "places.hpp"
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

/// A file in the temporary folder that goes with the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() / ("pelagos_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string obj_of(const TriangleMesh& mesh) {
  std::string text;
  for (const auto& v : mesh.vertices)
    text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
  for (const auto& t : mesh.triangles)
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  return text;
}

/// Every corner its own vertex, as in STL.
std::string stl_of(const TriangleMesh& mesh) {
  std::string text = "solid body\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& v = mesh.corner(t, c);
      text += "vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid body\n";
}

TEST(MeshFile, ReadsObjAndStlAlike) {
  const auto sphere = make_sphere(1.5, 10);
  const TemporaryFile obj("sphere.obj", obj_of(sphere)), stl("sphere.stl", stl_of(sphere));
  for (const auto& path : {obj.path(), stl.path()}) {
    const MeshFile file = read_mesh(path, {2.0});
    ASSERT_THAT(file.faults, IsEmpty()) << file.faults.front();
    EXPECT_EQ(file.mesh.vertices.size(), sphere.vertices.size());
    EXPECT_EQ(file.mesh.triangles.size(), sphere.triangles.size());
    EXPECT_NEAR(mesh_volume(file.mesh), 8 * mesh_volume(sphere), 1e-4);  // six decimals in the file
  }
}

TEST(MeshFile, SaysWhatIsWrongWithTheFile) {
  EXPECT_THAT(read_mesh("/nowhere/hull.obj").faults, Contains(Says("/nowhere/hull.obj")));
  const TemporaryFile garbage("garbage.obj", "v one two\nf 7 8 9\n\x01\x02");
  EXPECT_FALSE(read_mesh(garbage.path()).faults.empty());
  const TemporaryFile empty("empty.stl", "");
  EXPECT_FALSE(read_mesh(empty.path()).faults.empty());
  const TemporaryFile box("box.obj", obj_of(make_box({0, 0, 0}, {1, 1, 1})));
  EXPECT_THAT(read_mesh(box.path(), {-1.0}).faults, Contains(Says("scale")));
  EXPECT_THAT(read_mesh(box.path(), {std::numeric_limits<double>::infinity()}).faults, Contains(Says("scale")));
  EXPECT_THAT(read_mesh(box.path(), {1e9}).faults, Contains(Says("1e6 m")));
}

/// A glTF file of a box 2 m wide (x), 1 m high (y) and 4 m long (z), its numbers in the file itself or beside it.
std::string gltf_of_box(const std::string& buffer_uri, const std::string& nodes = R"({"mesh":0})") {
  std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
                     R"(],)"
                     R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
                     R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,0,-2],"max":[1,1,2]},)"
                     R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],"bufferViews":[)"
                     R"({"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72}],)"
                     R"("buffers":[{"byteLength":168,"uri":")";
  return text + buffer_uri + "\"}]}";
}

std::string bytes_of_box() {
  const auto box = make_box({-1, 0, -2}, {1, 1, 2});
  std::string bytes;
  for (const auto& v : box.vertices)
    for (const double c : {v.x(), v.y(), v.z()}) {
      const auto value = static_cast<float>(c);
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // little-endian machines only
    }
  for (const auto& t : box.triangles)
    for (const std::uint32_t v : t) bytes.append({static_cast<char>(v), 0});
  return bytes;
}

std::string base64_of(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k + 2 < bytes.size(); k += 3) {
    const auto byte = [&](std::size_t n) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[k + n])); };
    const unsigned all = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[all >> shift & 63];
  }
  return text;
}

TEST(MeshFile, TurnsGltfIntoBodyAxes) {
  const TemporaryFile file("box.gltf",
                           gltf_of_box("data:application/octet-stream;base64," + base64_of(bytes_of_box())));
  MeshOptions options;
  const MeshFile as_written = read_mesh(file.path(), options);
  ASSERT_THAT(as_written.faults, IsEmpty()) << as_written.faults.front();
  options.axes = MeshAxes::kZForwardYUp;
  const MeshFile turned = read_mesh(file.path(), options);
  ASSERT_THAT(turned.faults, IsEmpty()) << turned.faults.front();
  Eigen::AlignedBox3d before, after;
  for (const auto& v : as_written.mesh.vertices) before.extend(v);
  for (const auto& v : turned.mesh.vertices) after.extend(v);
  EXPECT_EQ(before.sizes(), Eigen::Vector3d(2, 1, 4));
  EXPECT_EQ(after.min(), Eigen::Vector3d(-2, -1, 0)) << "4 m along x, 2 m along y, 1 m up";
  EXPECT_EQ(after.max(), Eigen::Vector3d(2, 1, 1));
}

TEST(MeshFile, ReadsMirroredNodesRightSideOut) {
  const std::string uri = "data:application/octet-stream;base64," + base64_of(bytes_of_box());
  for (const std::string nodes :
       {R"({"mesh":0,"scale":[-1,1,1]})", R"({"children":[1],"scale":[-1,1,1]},{"mesh":0,"scale":[1,-1,1]})",
        R"({"children":[1],"scale":[-1,-1,-1]},{"mesh":0,"scale":[2,0.5,1]})",
        R"({"mesh":0,"matrix":[0,1,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]})"}) {
    const TemporaryFile file("mirrored.gltf", gltf_of_box(uri, nodes));
    const MeshFile read = read_mesh(file.path());
    ASSERT_THAT(read.faults, IsEmpty()) << nodes << read.faults.front();
    EXPECT_NEAR(mesh_volume(read.mesh), 8.0, 1e-9) << nodes;
  }
}

TEST(MeshFile, ReadsWhatLiesBesideTheFileAndNothingElse) {
  const TemporaryFile buffer("buffer.bin", bytes_of_box());
  const std::string name = std::filesystem::path(buffer.path()).filename().string();
  const TemporaryFile beside("beside.gltf", gltf_of_box(name));
  EXPECT_THAT(read_mesh(beside.path()).faults, IsEmpty());
  const std::string outside = "../etc/passwd";
  const TemporaryFile gltf("outside.gltf", gltf_of_box(outside));
  EXPECT_THAT(read_mesh(gltf.path()).faults, testing::ElementsAre(Says("etc/passwd; allowed: files in the mesh")));
  const TemporaryFile obj("outside.obj", "mtllib " + outside + "\n" + obj_of(make_sphere(1.0, 4)));
  EXPECT_THAT(read_mesh(obj.path()).faults, IsEmpty()) << "a body has no colours: the library is not opened";
  const TemporaryFile link("link.bin", "");
  std::filesystem::remove(link.path());
  std::filesystem::create_symlink("/etc/passwd", link.path());
  const TemporaryFile linked("linked.gltf", gltf_of_box(std::filesystem::path(link.path()).filename().string()));
  EXPECT_THAT(read_mesh(linked.path()).faults, testing::ElementsAre(Says("link.bin; allowed")));
  const TemporaryFile missing("missing.gltf", gltf_of_box("no_such_file.bin"));
  EXPECT_THAT(read_mesh(missing.path()).faults, SizeIs(1));
}

TEST(MeshFile, ReadsPolygonsWithCornersInTheMiddleOfEdges) {
  const TemporaryFile slab("slab.obj",
                           "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 2 0 1\nv 2 1 1\nv 0 1 1\n"
                           "f 5 4 3 2 1\nf 6 7 8 9 10\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\n");
  const MeshFile file = read_mesh(slab.path());
  ASSERT_THAT(file.faults, IsEmpty()) << file.faults.front();
  EXPECT_NEAR(mesh_volume(file.mesh), 2.0, 1e-12);
}

/// A box whose side y = 0 has vertices on the edge at its foot, which the bottom knows nothing of: flat triangles
/// between close the gap, as programs write them.
std::string box_with_flat_triangles(int between) {
  std::string text = obj_of(make_box({0, 0, 0}, {3, 1, 1}));
  const std::string side = "f 1 2 5\n";  // the triangle above the foot
  text.erase(text.find(side), side.size());
  std::string last = "1";
  for (int n = 1; n <= between; ++n) {
    const std::string here = std::to_string(8 + n);
    text += "v " + std::to_string(3.0 * n / (between + 1)) + " 0 0\n" + "f " + last + " " + here + " 5\n";
    text += "f " + here + " " + last + " 2\n";  // flat
    last = here;
  }
  return text + "f " + last + " 2 5\n";
}

TEST(MeshFile, MendsTrianglesWithoutAreaThatCloseGapsWithoutWidth) {
  for (const int between : {1, 2, 5}) {
    const TemporaryFile box("flat.obj", box_with_flat_triangles(between));
    const MeshFile file = read_mesh(box.path());
    ASSERT_THAT(file.faults, IsEmpty()) << between << " vertices: " << file.faults.front();
    EXPECT_NEAR(mesh_volume(file.mesh), 3.0, 1e-12);
    EXPECT_EQ(file.mesh.triangles.size(), file.origin.part.size());
  }
  const TemporaryFile alone("alone.obj",
                            obj_of(make_box({0, 0, 0}, {1, 1, 1})) + "v 2 0 0\nv 3 0 0\nv 4 0 0\nf 9 10 11\n");
  EXPECT_THAT(read_mesh(alone.path()).faults, Contains(Says("the face at line 24 at (2, 0, 0) m has no area")));
}

TEST(MeshFile, ClosesGapsWithoutWidth) {
  // The bottom is one square; the sides have more vertices along its edges than it has, off them by rounding.
  std::string text =
      "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 0 0 1\nv 3 0 1\nv 3 3 1\nv 0 3 1\n"
      "v 1 0.00001 0\nv 2 -0.00001 0\nv 3 1.5 0\nv 1 0 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 9 12 5\nf 9 10 12\nf 10 2 6 12\nf 2 11 7 6\nf 11 3 7\nf 3 4 8 7\nf 4 1 5 8\n";
  const TemporaryFile box("gaps.obj", text);
  const MeshFile file = read_mesh(box.path());
  ASSERT_THAT(file.faults, IsEmpty()) << file.faults.front();
  EXPECT_NEAR(mesh_volume(file.mesh), 9.0, 1e-4);
  EXPECT_EQ(file.mesh.triangles.size(), file.origin.part.size());
  // A gap with width stays one, and is named.
  text.replace(text.find("v 3 1.5 0"), 9, "v 3 1.5 .1");
  const TemporaryFile gap("gap.obj", text);
  EXPECT_THAT(read_mesh(gap.path()).faults, Contains(Says("open edge: only the face at line")));
}

TEST(MeshFile, AnInvertedPolygonIsNamedByItsLineAndTheAdviceHelps) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  const std::string before = "o crate\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\n", after = "f 3 4 8 7\nf 4 1 5 8\n";
  const TemporaryFile wrong("wrong.obj", vertices + before + "f 6 7 3 2\n" + after);
  EXPECT_THAT(read_mesh(wrong.path()).faults, testing::ElementsAre(Says("the face at line 13 of object \"crate\" at ")))
      << "one line for both triangles of the polygon";
  const TemporaryFile right("right.obj", vertices + before + "f 2 3 7 6\n" + after);  // its corners reversed
  EXPECT_THAT(read_mesh(right.path()).faults, IsEmpty());
}

TEST(MeshFile, TheSizeIsThatOfTheTriangles) {
  const TemporaryFile box(
      "far.obj", "v 1e9 0 0\n" + [] {
        std::string text;  // all faces counted back from the last vertex
        for (const char* v : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"}) text += std::string("v ") + v + "\n";
        return text + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
      }());
  const MeshFile file = read_mesh(box.path());
  ASSERT_THAT(file.faults, IsEmpty()) << "a vertex without a face is no part of the mesh: " << file.faults.front();
  EXPECT_NEAR(mesh_volume(file.mesh), 1.0 / 6.0, 1e-12);
}

TEST(MeshFile, ReadsTheShippedHullsAsTheyAre) {
  struct Hull {
    const char* name;
    std::size_t vertices, triangles;
    double volume;  // m^3, its parts added up
  };
  for (const Hull& hull : {Hull{"coaster", 1455, 2906, 1168.4}, Hull{"tanker", 1695, 3386, 3268.4},
                           Hull{"lighthouse", 1778, 3552, 1951.05}}) {
    const MeshFile file = read_mesh(test::source_path("assets/meshes/") + hull.name + "_hull.obj");
    ASSERT_THAT(file.faults, IsEmpty()) << file.faults.front();
    EXPECT_EQ(file.mesh.vertices.size(), hull.vertices) << hull.name;
    EXPECT_EQ(file.mesh.triangles.size(), hull.triangles) << hull.name;
    EXPECT_NEAR(mesh_volume(file.mesh), hull.volume, 1e-4 * hull.volume) << hull.name;
  }
}

TEST(MeshFile, NamesTheEndingsThatItReads) {
  const TemporaryFile file("box.fbx", obj_of(make_box({0, 0, 0}, {1, 1, 1})));
  EXPECT_THAT(read_mesh(file.path()).faults, testing::ElementsAre(Says("allowed: .obj, .stl, .gltf, .glb")));
}

TEST(MeshFile, SurvivesFilesThatAreCutOff) {
  const std::string texts[] = {obj_of(make_sphere(1.0, 4)), stl_of(make_sphere(1.0, 4)),
                               gltf_of_box("data:application/octet-stream;base64," + base64_of(bytes_of_box()))};
  const char* names[] = {"cut.obj", "cut.stl", "cut.gltf"};
  for (std::size_t kind = 0; kind < 3; ++kind)
    for (std::size_t part = 0; part < 40; ++part) {
      const TemporaryFile file(names[kind], texts[kind].substr(0, texts[kind].size() * part / 41));
      EXPECT_FALSE(read_mesh(file.path()).faults.empty()) << names[kind] << ", part " << part;
    }
}

}  // namespace
}  // namespace pelagos
