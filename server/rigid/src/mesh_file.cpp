#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "guarded_files.hpp"
#include "rigid/triangle_mesh.hpp"

namespace pelagos {

namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{512} << 20;
constexpr std::size_t kMostTriangles = 4'000'000;
constexpr std::string_view kEndings[] = {".obj", ".stl", ".gltf", ".glb"};
constexpr double kWeldPart = 1e-6;  ///< of the mesh's size

/// All triangles of all parts, in the order of the file. Adds to the faults where that is impossible.
class Collector {
 public:
  Collector(const aiScene& scene, double scale, MeshFile& file) : scene_(scene), scale_(scale), file_(file) {}

  void add_node(const aiNode& node, const aiMatrix4x4& above) {
    const aiMatrix4x4 placed = above * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m)
      add_part(*scene_.mMeshes[node.mMeshes[m]], placed, node.mName.length > 0 ? node.mName.C_Str() : "");
    for (unsigned c = 0; c < node.mNumChildren; ++c) add_node(*node.mChildren[c], placed);
  }

 private:
  void add_part(const aiMesh& part, const aiMatrix4x4& placed, const std::string& name) {
    TriangleMesh& mesh = file_.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    if (mesh.triangles.size() + part.mNumFaces > kMostTriangles) {
      file_.faults.assign(1, "more than " + std::to_string(kMostTriangles) + " triangles");
      return;
    }
    const bool moves = !placed.IsIdentity();
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D point = moves ? placed * part.mVertices[v] : part.mVertices[v];
      mesh.vertices.emplace_back(scale_ * static_cast<double>(point.x), scale_ * static_cast<double>(point.y),
                                 scale_ * static_cast<double>(point.z));
    }
    const bool mirrors = placed.Determinant() < 0;  // a mirror image has its corners in the opposite order
    const auto number = static_cast<std::uint32_t>(file_.origin.parts.size());
    file_.origin.parts.push_back("\"" + name + "\"");
    file_.origin.place_name.emplace_back("triangle");
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      mesh.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[mirrors ? 2 : 1], first + face.mIndices[mirrors ? 1 : 2]});
      file_.origin.part.push_back(number);
      file_.origin.place.push_back(f + 1);
    }
  }

  const aiScene& scene_;
  double scale_;
  MeshFile& file_;
};

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    if (vertex.allFinite()) largest = std::max(largest, (vertex - mesh.vertices.front()).cwiseAbs().maxCoeff());
  return std::isfinite(largest) ? largest : 0.0;
}

std::string lower_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Why a file cannot be a mesh, before it is opened; empty if it may be one.
std::string refuse_unread(const std::string& path, double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale))
    return "scale " + std::to_string(scale) + ": must be a finite number above 0";
  const std::string ending = lower_ending(path);
  if (std::find(std::begin(kEndings), std::end(kEndings), ending) == std::end(kEndings))
    return "meshes that end in \"" + ending + "\" are not read; allowed: .obj, .stl, .gltf, .glb";
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) return error.message();
  if (bytes > kLargestFile) return std::to_string(bytes >> 20) + " MB, at most 512 MB are read";
  return {};
}

/// Reads with Assimp; adds to the file's faults where that is impossible.
void import(const std::string& path, double scale, MeshFile& file) {
  Assimp::Importer importer;
  const auto files = new GuardedFiles(path, kLargestFile);
  importer.SetIOHandler(files);  // which owns it
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType);
  if (!files->refusal().empty()) {
    file.faults.push_back(files->refusal());
  } else if (scene == nullptr) {
    file.faults.emplace_back(importer.GetErrorString());
  } else {
    Collector(*scene, scale, file).add_node(*scene->mRootNode, {});
  }
}

MeshFile read_checked(const std::string& path, const MeshOptions& options) {
  MeshFile file;
  const std::string refusal = refuse_unread(path, options.scale);
  if (refusal.empty())
    import(path, options.scale, file);
  else
    file.faults.push_back(refusal);
  if (file.faults.empty()) {
    const Eigen::Matrix3d turn = body_from_file(options.axes);
    for (Eigen::Vector3d& vertex : file.mesh.vertices) vertex = turn * vertex;
    file.mesh = weld_parts(file.mesh, file.origin.part, kWeldPart * largest_coordinate(file.mesh));
    file.faults = find_mesh_faults(file.mesh, options.kind, file.origin);
  }
  for (std::string& fault : file.faults) fault.insert(0, path + ": ");
  return file;
}

}  // namespace

MeshFile read_mesh(const std::string& path, const MeshOptions& options) {
  try {
    return read_checked(path, options);
  } catch (const std::exception& error) {
    return {{}, {path + ": " + error.what()}};
  }
}

}  // namespace pelagos
