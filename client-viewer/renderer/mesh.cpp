#include "renderer/mesh.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <numbers>

namespace pelagos {

namespace {

constexpr float kCreaseDegrees = 35.0F;
// Linear. What is as large as a quay or a pier is built of concrete, what is smaller is a buoy or a crate.
constexpr std::array<float, 3> kMarkYellow{0.75F, 0.45F, 0.03F}, kConcrete{0.33F, 0.32F, 0.29F};
constexpr double kLargestMark = 10.0;  // m

Eigen::Vector3f turned(const Eigen::Matrix3f& turn, const aiVector3D& v) {
  return turn * Eigen::Vector3f(v.x, v.y, v.z);
}

void add_vertex(MeshData& data, const Eigen::Vector3f& p, const Eigen::Vector3f& n, float red, float green,
                float blue) {
  data.vertices.push_back({{p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}, {red, green, blue}});
  data.low = data.low.cwiseMin(p);
  data.high = data.high.cwiseMax(p);
}

MeshData empty_data() {
  MeshData data;
  data.low.setConstant(1e30F);
  data.high.setConstant(-1e30F);
  return data;
}

/// The triangles around each vertex.
std::vector<std::vector<std::size_t>> triangles_around(const TriangleMesh& mesh) {
  std::vector<std::vector<std::size_t>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) around[v].push_back(t);
  return around;
}

}  // namespace

MeshData load_mesh(const std::filesystem::path& file, double scale, MeshAxes axes) {
  Assimp::Importer importer;
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kCreaseDegrees);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                                              aiProcess_DropNormals | aiProcess_GenSmoothNormals |
                                                              aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw GraphicsError("mesh " + file.string() + ": " + importer.GetErrorString());
  MeshData data = empty_data();
  const Eigen::Matrix3f turn = body_from_file(axes).cast<float>();
  const auto factor = static_cast<float>(scale);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    aiColor4D colour(0.5F, 0.5F, 0.5F, 1.0F);
    aiGetMaterialColor(scene->mMaterials[part.mMaterialIndex], AI_MATKEY_COLOR_DIFFUSE, &colour);
    const auto first = static_cast<std::uint32_t>(data.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D n = part.HasNormals() ? part.mNormals[v] : aiVector3D(0, 0, 1);
      add_vertex(data, turned(turn, part.mVertices[v] * factor), turned(turn, n), colour.r, colour.g, colour.b);
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      if (part.mFaces[f].mNumIndices == 3)
        for (unsigned k = 0; k < 3; ++k) data.indices.push_back(first + part.mFaces[f].mIndices[k]);
  }
  if (data.indices.empty()) throw GraphicsError("mesh " + file.string() + ": holds no triangles");
  return data;
}

MeshData draw_primitive(const Primitive& primitive) {
  const TriangleMesh mesh = make_mesh(primitive);
  const double least_cosine = std::cos(static_cast<double>(kCreaseDegrees) * std::numbers::pi / 180.0);
  const auto around = triangles_around(mesh);
  MeshData data = empty_data();
  double reach = 0.0;
  for (const Eigen::Vector3d& v : mesh.vertices) reach = std::max(reach, v.cwiseAbs().maxCoeff());
  const auto& [red, green, blue] = 2.0 * reach > kLargestMark ? kConcrete : kMarkYellow;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d own = mesh.area_vector(t).normalized();
    for (const std::uint32_t v : mesh.triangles[t]) {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for (const std::size_t other : around[v])
        if (const Eigen::Vector3d area = mesh.area_vector(other); own.dot(area) >= least_cosine * area.norm())
          normal += area;
      data.indices.push_back(static_cast<std::uint32_t>(data.vertices.size()));
      add_vertex(data, mesh.vertices[v].cast<float>(), normal.normalized().cast<float>(), red, green, blue);
    }
  }
  return data;
}

MeshData load_body_mesh(const std::filesystem::path& folder, const std::string& mesh_file, double scale) {
  const MeshName name = parse_wire_name(mesh_file);
  if (name.primitive) return draw_primitive(*name.primitive);
  const std::filesystem::path file = drawn_mesh_file(folder, name.file);
  if (file.empty())
    throw GraphicsError("no mesh " + mesh_file + " in " + folder.string() +
                        "; it is not drawn (--assets names the folder that holds meshes/)");
  return load_mesh(file, scale, name.axes);
}

std::filesystem::path drawn_mesh_file(const std::filesystem::path& folder, const std::string& mesh_file) {
  const std::filesystem::path name = std::filesystem::path(mesh_file).filename();
  std::string stem = name.stem().string();
  if (stem.ends_with("_hull")) {
    const std::filesystem::path outfitted = folder / (stem.substr(0, stem.size() - 5) + name.extension().string());
    if (std::filesystem::exists(outfitted)) return outfitted;
  }
  return !name.empty() && std::filesystem::exists(folder / name) ? folder / name : std::filesystem::path();
}

Mesh::Mesh(const MeshData& data) : count_(static_cast<GLsizei>(data.indices.size())), low_(data.low), high_(data.high) {
  vertices_.upload(data.vertices.data(), data.vertices.size() * sizeof(MeshData::Vertex), GL_STATIC_DRAW);
  indices_.upload(data.indices.data(), data.indices.size() * sizeof(std::uint32_t), GL_STATIC_DRAW);
  glVertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(MeshData::Vertex));
  glVertexArrayElementBuffer(array_.id(), indices_.id());
  for (GLuint k = 0; k < 3; ++k) {
    glEnableVertexArrayAttrib(array_.id(), k);
    glVertexArrayAttribFormat(array_.id(), k, 3, GL_FLOAT, GL_FALSE, k * 3 * sizeof(float));
    glVertexArrayAttribBinding(array_.id(), k, 0);
  }
}

void Mesh::draw() const {
  array_.bind();
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace pelagos
