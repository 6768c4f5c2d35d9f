#pragma once

#include <Eigen/Core>
#include <vector>

#include "meshes/mesh_data.hpp"

namespace pelagos {

/// A mesh that is put together from parts, each in one colour.
class ColouredParts {
 public:
  void add(const TriangleMesh& part, const Eigen::Vector3d& place, const Colour& colour) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Eigen::Vector3d& vertex : part.vertices) mesh_.vertices.push_back(vertex + place);
    for (const auto& [a, b, c] : part.triangles) {
      mesh_.triangles.push_back({a + first, b + first, c + first});
      colours_.push_back(colour);
    }
  }
  void add_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Colour& colour) {
    add(make_mesh(BoxShape{high - low}), 0.5 * (low + high), colour);
  }
  /// A quarter turn anticlockwise about z.
  void turn() {
    for (Eigen::Vector3d& vertex : mesh_.vertices) vertex = {-vertex.y(), vertex.x(), vertex.z()};
  }
  void move(const Eigen::Vector3d& by) {
    for (Eigen::Vector3d& vertex : mesh_.vertices) vertex += by;
  }
  [[nodiscard]] MeshData done() const { return shade(mesh_, colours_); }

 private:
  TriangleMesh mesh_;
  std::vector<Colour> colours_;
};

}  // namespace pelagos
