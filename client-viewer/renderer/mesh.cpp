#include "renderer/mesh.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

namespace pelagos {

MeshData load_mesh(const std::filesystem::path& file, double scale) {
  Assimp::Importer importer;
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 35.0F);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                                              aiProcess_DropNormals | aiProcess_GenSmoothNormals |
                                                              aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw GraphicsError("mesh " + file.string() + ": " + importer.GetErrorString());
  MeshData data;
  data.low.setConstant(1e30F);
  data.high.setConstant(-1e30F);
  const auto factor = static_cast<float>(scale);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    aiColor4D colour(0.5F, 0.5F, 0.5F, 1.0F);
    aiGetMaterialColor(scene->mMaterials[part.mMaterialIndex], AI_MATKEY_COLOR_DIFFUSE, &colour);
    const auto first = static_cast<std::uint32_t>(data.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = part.mVertices[v] * factor;
      const aiVector3D n = part.HasNormals() ? part.mNormals[v] : aiVector3D(0, 0, 1);
      data.vertices.push_back({{p.x, p.y, p.z}, {n.x, n.y, n.z}, {colour.r, colour.g, colour.b}});
      data.low = data.low.cwiseMin(Eigen::Vector3f(p.x, p.y, p.z));
      data.high = data.high.cwiseMax(Eigen::Vector3f(p.x, p.y, p.z));
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      if (part.mFaces[f].mNumIndices == 3)
        for (unsigned k = 0; k < 3; ++k) data.indices.push_back(first + part.mFaces[f].mIndices[k]);
  }
  if (data.indices.empty()) throw GraphicsError("mesh " + file.string() + ": holds no triangles");
  return data;
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
