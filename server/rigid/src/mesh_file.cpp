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

/// All triangles of all parts, in the order of the file. Adds to `faults` where that is impossible.
TriangleMesh collect_triangles(const aiScene& scene, double scale, std::vector<std::string>& faults) {
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    if (mesh.triangles.size() + part.mNumFaces > kMostTriangles) {
      faults.push_back("more than " + std::to_string(kMostTriangles) + " triangles");
      return mesh;
    }
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& point = part.mVertices[v];
      mesh.vertices.emplace_back(scale * static_cast<double>(point.x), scale * static_cast<double>(point.y),
                                 scale * static_cast<double>(point.z));
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 3)
        mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
  return mesh;
}

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
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType);
  if (!files->refusal().empty()) {
    file.faults.push_back(files->refusal());
  } else if (scene == nullptr) {
    file.faults.emplace_back(importer.GetErrorString());
  } else {
    file.mesh = collect_triangles(*scene, scale, file.faults);
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
    file.mesh = weld_vertices(file.mesh, kWeldPart * largest_coordinate(file.mesh));
    file.faults = find_mesh_faults(file.mesh, options.kind);
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
