#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "mesh_files.hpp"

namespace pelagos {
namespace {

using test::first_fault;
using test::imported;
using test::replaced;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());  // on little-endian machines
  return bytes;
}

std::string base64_of(std::string bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.resize(bytes.size() + padding);
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t all = 0;
    for (std::size_t n = 0; n < 3; ++n) all = all << 8 | static_cast<unsigned char>(bytes[k + n]);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[all >> shift & 63];
  }
  text.replace(text.size() - padding, padding, std::string(padding, '='));
  return text;
}

/// A tetrahedron of 8/6: four vertices, then twelve indices of two bytes.
const std::string kBytes = bytes_of<float>({0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2}) +
                           bytes_of<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
constexpr double kVolume = 8.0 / 6.0;

const std::string kViews =
    R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}])";
const std::string kAccessors = R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
                               R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}])";
const std::string kMeshes = R"("meshes":[{"name":"hull","primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";
const std::string kScene = R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"ship","mesh":0}])";

std::string buffer_of(const std::string& bytes) {
  return R"("buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + base64_of(bytes) + R"("}])";
}

std::string joined(const std::vector<std::string>& members) {
  std::string text = R"({"asset":{"version":"2.0"})";
  for (const std::string& member : members) text += "," + member;
  return text + "}";
}

const std::string kPlain = joined({kScene, kMeshes, kAccessors, kViews, buffer_of(kBytes)});

void expect_tetrahedron(const std::string& what, const ImportedMesh& mesh, double volume = kVolume) {
  ASSERT_THAT(mesh.faults, IsEmpty()) << what << ": " << first_fault(mesh);
  EXPECT_THAT(mesh.triangles, SizeIs(4)) << what;
  EXPECT_TRUE(test::is_closed(mesh)) << what;
  EXPECT_NEAR(test::volume_of(mesh), volume, 1e-6) << what;
}

void expect_fault(const std::string& text, const std::vector<std::string>& says, const std::string& name = "a.gltf") {
  const ImportedMesh mesh = imported(name, text);
  ASSERT_THAT(mesh.faults, SizeIs(1)) << says[0];
  EXPECT_THAT(mesh.triangles, IsEmpty());
  for (const std::string& words : says) EXPECT_THAT(first_fault(mesh), HasSubstr(words));
}

std::string chunk(const std::string& kind, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(bytes.size())}) + kind + bytes;
}

std::string glb_of(const std::string& json, const std::string& bytes) {
  const std::string chunks = chunk("JSON", json, ' ') + chunk(std::string("BIN\0", 4), bytes, '\0');
  return "glTF" + bytes_of<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
}

TEST(Gltf, TextAndBinary) {
  expect_tetrahedron("text", imported("a.gltf", kPlain));
  expect_tetrahedron("BOM", imported("a.gltf", "\xEF\xBB\xBF" + kPlain));
  expect_tetrahedron("slashes as JSON may write them",
                     imported("a.gltf", replaced(replaced(kPlain, "AAAA", "AAAA"), "/", "\\/")));
  const std::string glb =
      glb_of(joined({kScene, kMeshes, kAccessors, kViews, R"("buffers":[{"byteLength":72}])"}), kBytes);
  expect_tetrahedron("binary", imported("a.glb", glb));
  expect_tetrahedron("binary under the other name", imported("a.gltf", glb));
  expect_tetrahedron("text under the other name", imported("a.glb", kPlain));
  expect_tetrahedron("upper case", imported("A.GLB", glb));
  expect_tetrahedron("bytes after the end", imported("a.glb", glb + "more"));
  expect_fault(glb.substr(0, glb.size() - 1), {"cut off"}, "a.glb");
  expect_fault("glTF", {"cut off"}, "a.glb");
}

TEST(Gltf, TrianglesKnowTheirMeshAndNode) {
  const ImportedMesh mesh = imported("a.gltf", kPlain);
  ASSERT_THAT(mesh.parts, SizeIs(1));
  EXPECT_EQ(mesh.parts[0].name, "mesh \"hull\" at node \"ship\"");
  EXPECT_EQ(mesh.parts[0].place, "triangle");
  EXPECT_EQ(mesh.triangles[2].place, 3u);
  const ImportedMesh unnamed =
      imported("a.gltf", replaced(replaced(kPlain, R"("name":"hull",)", ""), R"("name":"ship",)", ""));
  EXPECT_EQ(unnamed.parts.at(0).name, "mesh 0 at node 0");
}

TEST(Gltf, BuffersBesideTheFile) {
  const auto with_uri = [](const std::string& uri) {
    return joined({kScene, kMeshes, kAccessors, kViews, R"("buffers":[{"byteLength":72,"uri":")" + uri + "\"}]"});
  };
  const test::MeshFiles files;
  files.write("model/my hull.bin", kBytes);
  files.write("model/100%25.bin", kBytes);
  files.write("secret.bin", kBytes);
  const auto read = [&](const std::string& uri) { return import_mesh(files.write("model/a.gltf", with_uri(uri))); };
  expect_tetrahedron("percent-encoded", read("my%20hull.bin"));
  expect_tetrahedron("as written", read("my hull.bin"));
  expect_tetrahedron("in a folder", read("./../model/my%20hull.bin"));
  expect_tetrahedron("a name with a percent sign", read("100%25.bin"));
  for (const std::string uri : {"../secret.bin", "%2e%2e/secret.bin", "/etc/passwd", "my%20hull.bin/../../secret.bin"})
    EXPECT_THAT(first_fault(read(uri)), HasSubstr("own folder or below")) << uri;
  for (const std::string uri : {"http://localhost/a.bin", "file:///etc/passwd", "ftp:a/b"})
    EXPECT_THAT(first_fault(read(uri)), HasSubstr("allowed: data URIs, and files beside the mesh")) << uri;
  EXPECT_THAT(first_fault(read("none.bin")), HasSubstr("none.bin"));
  EXPECT_THAT(first_fault(read(".")), HasSubstr("regular file"));
  files.write("model/short.bin", kBytes.substr(0, 71));
  EXPECT_THAT(first_fault(read("short.bin")), AllOf(HasSubstr("buffers[0].byteLength is 72"), HasSubstr("71 bytes")));
}

TEST(Gltf, NodesPlaceAndMirror) {
  const auto with_nodes = [](const std::string& nodes) {
    return imported("a.gltf", replaced(kPlain, R"("nodes":[{"name":"ship","mesh":0}])", "\"nodes\":[" + nodes + "]"));
  };
  expect_tetrahedron("scale", with_nodes(R"({"mesh":0,"scale":[2,1,0.5],"translation":[9,0,0]})"));
  expect_tetrahedron("mirror", with_nodes(R"({"mesh":0,"scale":[-1,1,1],"rotation":[0,0,0.7071068,0.7071068]})"));
  expect_tetrahedron("mirror of a mirror",
                     with_nodes(R"({"children":[1],"scale":[-1,1,1]},{"mesh":0,"scale":[1,-1,1]})"));
  expect_tetrahedron("mirror of three", with_nodes(R"({"children":[1],"scale":[-1,-1,-1]},{"mesh":0,"scale":[2,1,1]})"),
                     2 * kVolume);
  expect_tetrahedron("matrix", with_nodes(R"({"mesh":0,"matrix":[0,1,0,0, 1,0,0,0, 0,0,1,0, 5,6,7,1]})"));
  const ImportedMesh placed = with_nodes(R"({"children":[1],"translation":[10,0,0]},{"mesh":0,"translation":[0,5,0]})");
  EXPECT_EQ(placed.vertices.at(0), Eigen::Vector3d(10, 5, 0));
  EXPECT_THAT(first_fault(with_nodes(R"({"name":"flat","mesh":0,"scale":[1,0,1]})")),
              AllOf(HasSubstr("node \"flat\""), HasSubstr("scale of 0")));
  EXPECT_THAT(first_fault(with_nodes(R"({"mesh":0,"scale":[1,"x",1]})")),
              HasSubstr("nodes[0].scale must be a list of 3"));
  EXPECT_THAT(first_fault(with_nodes(R"({"mesh":7})")), HasSubstr("meshes[7]"));
}

TEST(Gltf, OnlyTheSceneThatItShows) {
  const std::string nodes = R"("nodes":[{"mesh":0},{"mesh":0,"translation":[9,0,0]},{"mesh":0}])";
  const auto count = [&](const std::string& scenes) {
    const ImportedMesh mesh =
        imported("a.gltf", joined({scenes + nodes, kMeshes, kAccessors, kViews, buffer_of(kBytes)}));
    EXPECT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
    return mesh.triangles.size();
  };
  EXPECT_EQ(count(R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1,2]}],)"), 8u);
  EXPECT_EQ(count(R"("scenes":[{"nodes":[0]},{"nodes":[1,2]}],)"), 4u) << "the first, where none is chosen";
  EXPECT_EQ(count(""), 12u) << "all nodes, where there are no scenes";
}

TEST(Gltf, ListsStripsFansAndNoIndices) {
  const auto shape = [](const std::string& primitive, const std::string& positions, std::size_t count) {
    const std::string meshes = R"("meshes":[{"primitives":[)" + primitive + "]}]";
    const std::string accessors =
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" + std::to_string(count) + R"(,"type":"VEC3"}])";
    const std::string views = R"("bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(positions.size()) + "}]";
    return imported("a.gltf", joined({kScene, meshes, accessors, views, buffer_of(positions)}));
  };
  const std::vector<float> o{0, 0, 0}, x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
  const auto points = [](const std::vector<std::vector<float>>& list) {
    std::string bytes;
    for (const auto& point : list) bytes += bytes_of(point);
    return bytes;
  };
  expect_tetrahedron("list",
                     shape(R"({"attributes":{"POSITION":0}})", points({o, y, x, o, x, z, o, z, y, x, y, z}), 12));
  expect_tetrahedron("strip", shape(R"({"attributes":{"POSITION":0},"mode":5})", points({o, y, x, z, o, y}), 6));
  const ImportedMesh fan = shape(R"({"attributes":{"POSITION":0},"mode":6})", points({o, y, x, z, y}), 5);
  EXPECT_THAT(fan.triangles, SizeIs(3));
  EXPECT_NEAR(test::volume_of(fan), 0.0, 1e-12);
  EXPECT_THAT(fan.triangles[0].corners, ElementsAre(1, 2, 0));
  EXPECT_THAT(first_fault(shape(R"({"attributes":{"POSITION":0},"mode":1})", points({o, x}), 2)),
              HasSubstr("no triangles"));
  EXPECT_THAT(first_fault(shape(R"({"attributes":{"POSITION":0},"mode":9})", points({o, x}), 2)),
              HasSubstr("mode is 9"));
}

TEST(Gltf, SparseAndQuantizedPositions) {
  const std::string sparse_bytes = bytes_of<std::uint8_t>({1, 2, 3, 0}) + bytes_of<float>({2, 0, 0, 0, 2, 0, 0, 0, 2});
  const std::string views =
      R"("bufferViews":[{"buffer":0,"byteOffset":72,"byteLength":3},)"
      R"({"buffer":0,"byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":76,"byteLength":36}])";
  const std::string sparse = R"({"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":3,)"
                             R"("indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":2}}})";
  const std::string indices = R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"})";
  const std::string text = joined(
      {kScene, kMeshes, "\"accessors\":[" + sparse + "," + indices + "]", views, buffer_of(kBytes + sparse_bytes)});
  expect_tetrahedron("sparse, of zeros", imported("a.gltf", text));
  expect_fault(replaced(text, R"("sparse":{"count":3)", R"("sparse":{"count":5)"), {"accessors[0].sparse.count"});
  expect_fault(replaced(text, R"("byteOffset":72,"byteLength":3)", R"("byteOffset":72,"byteLength":2)"),
               {"accessors[0].sparse.indices has 3 elements", "2 bytes"});

  const std::string bytes =
      bytes_of<std::uint16_t>({0, 0, 0, 9, 65535, 0, 0, 9, 0, 65535, 0, 9, 0, 0, 65535, 9}) + kBytes.substr(48);
  const std::string quantized = joined(
      {R"("extensionsRequired":["KHR_mesh_quantization"])", kScene, kMeshes,
       replaced(kAccessors, R"("componentType":5126)", R"("normalized":true,"componentType":5123)"),
       R"("bufferViews":[{"buffer":0,"byteLength":32,"byteStride":8},{"buffer":0,"byteOffset":32,"byteLength":24}])",
       buffer_of(bytes)});
  expect_tetrahedron("shorts as parts of one, eight bytes apart", imported("a.gltf", quantized), 1.0 / 6.0);
}

TEST(Gltf, RefusesWhatItCannotRead) {
  expect_fault(replaced(kPlain, R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"],"scene":0)"),
               {"KHR_draco_mesh_compression", "without compression"});
  expect_fault(replaced(kPlain, R"("version":"2.0")", R"("version":"1.0")"), {"glTF 1.0", "allowed: glTF 2"});
  expect_fault("{}", {"asset.version is missing"});
  expect_fault("[1,2]", {"is no glTF"});
  expect_fault("", {"is no JSON"});
  expect_fault(kPlain.substr(0, kPlain.size() - 2), {"is no JSON", "line 1"});
  expect_fault(replaced(kPlain, ";base64,", ";base64,!"), {"buffers[0].uri", "not base64"});
  expect_fault(replaced(kPlain, R"("POSITION":0)", R"("NORMAL":0)"), {"meshes[0].primitives[0].attributes.POSITION"});
  expect_fault(replaced(kPlain, R"("type":"VEC3")", R"("type":"VEC2")"), {"accessors[0].type", "VEC3"});
  expect_fault(replaced(kPlain, R"("componentType":5126)", R"("componentType":5130)"),
               {"accessors[0].componentType is 5130"});
  expect_fault(replaced(kPlain, R"({"bufferView":0,)", "{"), {"accessors[0].bufferView is missing", "compression"});
  expect_fault(replaced(kPlain, R"("count":4)", R"("count":3)"),
               {"meshes[0].primitives[0].indices name vertex 3 of 3"});
  expect_fault(replaced(kPlain, R"("count":4)", R"("count":5)"), {"accessors[0] has 5 elements"});
  expect_fault(replaced(kPlain, R"("count":4)", R"("count":-4)"), {"accessors[0].count is -4"});
  expect_fault(replaced(kPlain, R"("count":4)", R"("count":1e30)"), {"accessors[0].count"});
  expect_fault(replaced(kPlain, R"("byteOffset":48)", R"("byteOffset":999999999999)"), {"bufferViews[1] goes beyond"});
  expect_fault(replaced(kPlain, R"("byteLength":48)", R"("byteLength":48,"byteStride":4)"), {"byteStride"});
  expect_fault(replaced(kPlain, R"("nodes":[0])", R"("nodes":[3])"), {"scenes[0].nodes names node 3"});
  expect_fault(replaced(kPlain, R"("nodes":[0])", R"("nodes":"all")"), {"scenes[0].nodes is no list"});
}

TEST(Gltf, ColoursOfMaterials) {
  const std::string text =
      replaced(replaced(kPlain, R"("indices":1)", R"("indices":1,"material":0)"), R"("scene":0)",
               R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1]}}],"scene":0)");
  const ImportedMesh mesh = imported("a.gltf", text, {.materials = true});
  ASSERT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
  EXPECT_THAT(mesh.materials.at(mesh.triangles.at(0).material).colour, ElementsAre(0.5F, 0.25F, 1.0F));
  EXPECT_EQ(imported("a.gltf", text).triangles.at(0).material, 0u);
}

}  // namespace
}  // namespace pelagos
