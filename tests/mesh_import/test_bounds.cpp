// Files that would take a careless reader minutes or gigabytes, each small enough for a unit test. How long the
// importer takes in all is bounded here loosely, for the tests run under sanitizers too.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "mesh_files.hpp"

namespace pelagos {
namespace {

using test::first_fault;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t n = 0; n < count; ++n) all += text;
  return all;
}

struct Hostile {
  const char* name;
  const char* ending;
  std::string (*text)();
  const char* says;
};
void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

const std::string kGltf = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[)";
const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kZeros =  // positions of a sparse accessor without anything in it
    R"("bufferViews":[{"buffer":0,"byteLength":0}],"buffers":[{"byteLength":0,"uri":"data:,"}],"accessors":[)"
    R"({"componentType":5126,"count":3000,"type":"VEC3","sparse":{"count":0,)"
    R"("indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}}])";

std::string chain_of_nodes() {
  std::string text = kGltf;
  for (int n = 1; n < 5000; ++n) text += "{\"children\":[" + std::to_string(n) + "]},";
  return text + "{}]}";
}

std::string doubled_nodes() {
  std::string text = kGltf;
  for (int n = 1; n < 40; ++n) text += "{\"children\":[" + std::to_string(n) + "," + std::to_string(n) + "]},";
  return text + "{}]}";
}

std::string one_mesh_at_many_nodes() {
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0})" + repeated(R"(,{"mesh":0})", 2000);
  return text + R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" + kZeros + "}";
}

std::string polygon(int corners) {
  std::string text;
  for (int n = 0; n < corners; ++n) {
    const double angle = 6.283185307 * n / corners, radius = 1 + n % 2;
    text += "v " + std::to_string(radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) + " 0\n";
  }
  return text;
}

std::string face(int corners) {
  std::string text = "f";
  for (int n = 1; n <= corners; ++n) text += " " + std::to_string(n);
  return text + "\n";
}

std::string objects() {
  std::string text = kPoints;
  for (int n = 0; n < 20'000; ++n) text += "o a" + std::to_string(n) + "\nf 1 2 3\n";
  return text;
}

std::vector<Hostile> hostile() {
  return {
      {"Lists", "gltf", [] { return std::string(500'000, '['); }, "brackets inside each other"},
      {"Objects", "gltf", [] { return repeated("{\"a\":", 100'000); }, "brackets inside each other"},
      {"Values", "gltf", [] { return R"({"asset":{"version":"2.0"},"extras":[)" + repeated("[],", 1'000'000) + "0]}"; },
       "more than 1000000 values"},
      {"ChainOfNodes", "gltf", chain_of_nodes, "below more than 256 others"},
      {"DoubledNodes", "gltf", doubled_nodes, "one parent for each node"},
      {"NodeBelowItself", "gltf", [] { return kGltf + R"({"children":[0]}]})"; }, "one parent for each node"},
      {"OneMeshAtManyNodes", "gltf", one_mesh_at_many_nodes, "triangles; reduce the mesh"},
      {"CountBeyondBytes", "gltf",
       [] {
         return kGltf + R"({"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                        R"("accessors":[{"componentType":5126,"count":900000000000,"type":"VEC3","sparse":{}}]})";
       },
       "vertices; reduce the mesh"},
      {"FacetsBeyondBytes", "stl", [] { return std::string(80, ' ') + std::string("\xFF\xFF\xFF\x7F\0\0", 6); },
       "cut off"},
      {"LargePolygon", "obj", [] { return polygon(10'000) + face(10'000); }, "has 10000 corners; allowed: up to 4096"},
      {"ManyConcavePolygons", "obj", [] { return polygon(2000) + repeated(face(2000), 100); },
       "too many concave corners"},
      {"ManyObjects", "obj", objects, "more than 10000 objects"},
      {"ManyVertices", "obj", [] { return repeated("v 0 0 0\n", MeshLimits::kVertices + 1); }, "vertices; reduce"},
      {"ManyTriangles", "obj", [] { return kPoints + repeated("f 1 2 3\n", MeshLimits::kTriangles + 1); },
       "triangles; reduce"},
      {"LongLine", "obj", [] { return "#" + std::string(2u << 20, 'x'); }, "longer than 1048576"},
      {"LongContinuedLine", "obj", [] { return repeated("\\\n", 2u << 20); }, "line 1: longer than 1048576"},
  };
}

class Bounds : public ::testing::TestWithParam<Hostile> {};

TEST_P(Bounds, AreSaidSoon) {
  const test::MeshFiles files;
  const auto path = files.write(std::string("a.") + GetParam().ending, GetParam().text());
  const auto start = std::chrono::steady_clock::now();
  const ImportedMesh mesh = import_mesh(path);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << "a fraction of a second in Release";
  ASSERT_THAT(mesh.faults, SizeIs(1));
  EXPECT_THAT(first_fault(mesh), HasSubstr(GetParam().says));
  EXPECT_THAT(mesh.triangles, IsEmpty());
  EXPECT_THAT(mesh.vertices, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Files, Bounds, ::testing::ValuesIn(hostile()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Bounds, ManyMaterialsAndEmptyObjectsAreNoMatter) {
  std::string text = kPoints;
  for (int n = 0; n < 20'000; ++n) text += "usemtl m" + std::to_string(n) + "\no a" + std::to_string(n) + "\n";
  EXPECT_THAT(test::imported("a.obj", text + "f 1 2 3\n").triangles, SizeIs(1));
  EXPECT_THAT(first_fault(test::imported("a.obj", text + "f 1 2 3\n", {.materials = true})),
              HasSubstr("10000 materials"));
}

TEST(Bounds, FilesThatAreNoFiles) {
  const test::MeshFiles files;
  const auto pipe = files.folder() / "pipe.obj";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(first_fault(import_mesh(pipe)), HasSubstr("regular file")) << "nobody writes to it: it must not wait";
  std::filesystem::create_directories(files.folder() / "folder.stl");
  EXPECT_THAT(first_fault(import_mesh(files.folder() / "folder.stl")), HasSubstr("regular file"));
  EXPECT_THAT(first_fault(import_mesh(files.folder() / "none.obj")), HasSubstr("No such file"));
  EXPECT_THAT(first_fault(import_mesh(files.write("a.fbx", "x"))), HasSubstr("allowed: .obj, .stl, .gltf, .glb"));
  const auto large = files.write("large.obj", "");
  std::filesystem::resize_file(large, MeshLimits::kBytes + 1);  // without taking room on the disk
  EXPECT_THAT(first_fault(import_mesh(large)), HasSubstr("allowed: 128 MB"));
}

/// Files with some of their bytes changed, lost or doubled, in an order that is the same each time.
TEST(Bounds, ChangedFilesAreReadOrRefused) {
  const std::string obj = "o a\n" + kPoints + "v 0 0 1\nf 1 3 2\nf 1 2 4 -2\ng b\nf 2//1 3/1 4\nusemtl x\n";
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 0\n"
      "endloop\nendfacet\nendsolid a\n";
  const std::string gltf = one_mesh_at_many_nodes();
  const std::string gltf_start = gltf.substr(0, 60), gltf_end = gltf.substr(gltf.find("],\"meshes\""));
  const std::string binary = std::string(80, 'h') + std::string("\2\0\0\0", 4) + std::string(100, '\1');
  const std::pair<const char*, std::string> seeds[] = {
      {"a.obj", obj}, {"a.stl", stl}, {"a.gltf", gltf_start + "\"mesh\":0}" + gltf_end}, {"b.stl", binary}};
  const test::MeshFiles files;
  std::uint64_t random = 88172645463325252u;
  const auto next = [&](std::size_t below) {
    random ^= random << 13, random ^= random >> 7, random ^= random << 17;
    return static_cast<std::size_t>(random % below);
  };
  const std::string interesting = "0123456789-+.eE{}[]\":,\\/ \t\r\n\xFF";
  for (int round = 0; round < 300; ++round) {
    const auto& [name, seed] = seeds[static_cast<std::size_t>(round) % 4];
    std::string text = seed;
    for (std::size_t change = next(6) + 1; change > 0 && !text.empty(); --change) {
      const std::size_t at = next(text.size()), length = next(std::min<std::size_t>(text.size() - at, 30)) + 1;
      switch (next(4)) {
        case 0:
          text[at] = static_cast<char>(next(256));
          break;
        case 1:
          text[at] = interesting[next(interesting.size())];
          break;
        case 2:
          text.erase(at, length);
          break;
        default:
          text.insert(at, text.substr(at, length));
          break;
      }
    }
    const ImportedMesh mesh = import_mesh(files.write(name, text), {.materials = true});
    EXPECT_NE(mesh.faults.empty(), mesh.triangles.empty());
    for (const ImportedTriangle& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle.corners) ASSERT_LT(corner, mesh.vertices.size());
      ASSERT_LT(triangle.part, mesh.parts.size());
      ASSERT_LT(triangle.material, mesh.materials.size());
    }
  }
}

}  // namespace
}  // namespace pelagos
