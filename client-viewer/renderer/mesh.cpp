#include "renderer/mesh.hpp"

namespace pelagos {

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
