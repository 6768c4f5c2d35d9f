#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rigid/box_nodes.hpp"
#include "rigid/triangle_mesh.hpp"

namespace pelagos {

/// Where a surface cuts itself.
struct SelfIntersections {
  std::size_t pairs = 0;                 ///< of triangles
  std::array<std::uint32_t, 2> first{};  ///< the first pair, numbered as in the mesh; none where pairs is 0
  bool all = true;                       ///< false: there were too many to look at all
};

/// The place of a surface that is nearest to a point.
struct NearestPlace {
  Eigen::Vector3d place;  ///< m
  Eigen::Vector3d
      normal;  ///< unit, of its face; of faces equally near, at an edge or a corner, of that seen most steeply
  double distance = 0.0;  ///< m
  double height = 0.0;    ///< m, of the point above that face's plane; negative: it is behind the surface
};

/// Distances, rays and inside tests on a mesh, through a tree of bounding boxes: the time of a query grows with the
/// logarithm of the number of triangles. Immutable after construction; any number of threads may ask.
class MeshQuery {
 public:
  MeshQuery() = default;
  /// @param mesh  without faults (find_mesh_faults)
  explicit MeshQuery(const TriangleMesh& mesh);

  /// Distance from `point` to the surface, m; `limit` where it is not nearer than that.
  [[nodiscard]] double distance(const Eigen::Vector3d& point, double limit) const;

  /// Nothing where the surface is not nearer than `limit`, m.
  [[nodiscard]] std::optional<NearestPlace> nearest(const Eigen::Vector3d& point, double limit) const;

  /// How far a ray runs before it meets the surface, m: the first meeting farther than `skip`; infinity if none.
  /// @param direction  unit
  [[nodiscard]] double first_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, double skip) const;

  /// Whether `point` is inside a closed mesh: a ray leaves it more often than it enters. So the union of shells that
  /// overlap is inside. Of three fixed skew rays the majority decides, so that one which grazes an edge does no harm.
  /// Outside the bounding box the answer is immediate.
  [[nodiscard]] bool inside(const Eigen::Vector3d& point) const;

  /// Whether `point` is behind the nearest face: the inside of an open mesh, which goes on past its rim as its rim
  /// lies. Of faces equally near, at an edge or a corner, the one seen most steeply decides.
  [[nodiscard]] bool behind(const Eigen::Vector3d& point) const;

  /// Pairs of triangles that cut each other; pairs that share a vertex are not looked at, and neither is overlap within
  /// one plane. After so many pairs whose boxes meet (kMostPairs) it ends.
  /// @param part  [triangles] if not empty: pairs of different parts are not looked at either
  [[nodiscard]] SelfIntersections find_self_intersections(std::span<const std::uint32_t> part = {}) const;

  [[nodiscard]] const Eigen::AlignedBox3d& bounding_box() const { return box_; }

 private:
  struct Triangle {
    Eigen::Vector3d corner, edge1, edge2;
    std::uint32_t number;                   ///< in the mesh
    std::array<std::uint32_t, 3> vertices;  ///< likewise
    [[nodiscard]] Eigen::Vector3d normal() const { return edge1.cross(edge2).normalized(); }
  };
  /// Calls visit(triangle, its nearest place) for triangles nearer than the limit that visit returned last; squared.
  template <class Visit>
  void for_each_near(const Eigen::Vector3d& point, double limit_squared, Visit&& visit) const;
  template <class Visit>
  void for_each_in(const Eigen::AlignedBox3d& box, Visit&& visit) const;
  template <class Visit>
  void for_each_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, Visit&& visit) const;

  Eigen::AlignedBox3d box_;
  std::vector<BoxNode> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace pelagos
