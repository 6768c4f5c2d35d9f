#pragma once

#include <Eigen/Core>

#include "meshes/mesh_data.hpp"
#include "renderer/gl_objects.hpp"

namespace pelagos {

/// A mesh on the graphics card.
class Mesh {
 public:
  explicit Mesh(const MeshData& data);
  void draw() const;
  [[nodiscard]] const Eigen::Vector3f& low() const { return low_; }
  [[nodiscard]] const Eigen::Vector3f& high() const { return high_; }

 private:
  Buffer vertices_, indices_;
  VertexArray array_;
  GLsizei count_;
  Eigen::Vector3f low_, high_;
};

}  // namespace pelagos
