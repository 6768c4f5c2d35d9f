#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

/// Distances, rays and inside tests on a closed mesh, through a tree of bounding boxes: the time of a query grows with
/// the logarithm of the number of triangles. Immutable after construction; any number of threads may ask.
class MeshQuery {
 public:
  MeshQuery() = default;
  /// @param mesh  without faults (find_mesh_faults)
  explicit MeshQuery(const TriangleMesh& mesh);

  /// Distance from `point` to the surface, m; `limit` where it is not nearer than that.
  [[nodiscard]] double distance(const Eigen::Vector3d& point, double limit) const;

  /// How far a ray runs before it meets the surface, m: the first meeting farther than `skip`; infinity if none.
  /// @param direction  unit
  [[nodiscard]] double first_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, double skip) const;

  /// Whether `point` is inside, by the parity of crossings of three fixed skew rays, the majority deciding, so that a
  /// ray which grazes an edge does no harm. Outside the bounding box the answer is immediate.
  [[nodiscard]] bool inside(const Eigen::Vector3d& point) const;

  [[nodiscard]] const Eigen::AlignedBox3d& bounding_box() const { return box_; }

 private:
  struct Triangle {
    Eigen::Vector3d corner, edge1, edge2;
  };
  /// A leaf where count > 0: triangles first .. first + count - 1; else children first and first + 1.
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0, count = 0;
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::vector<std::uint32_t>& order,
             const TriangleMesh& mesh);
  template <class Visit>
  void for_each_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, Visit&& visit) const;

  Eigen::AlignedBox3d box_;
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace pelagos
