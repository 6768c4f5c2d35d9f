#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pelagos {

/// A surface of triangles in body axes (x forward, y port, z up), metres; corners anticlockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] const Eigen::Vector3d& corner(std::size_t triangle, std::size_t which) const {
    return vertices[triangles[triangle][which]];
  }
  /// Half the cross product of two edges: the triangle's area, m^2, along its outward normal.
  [[nodiscard]] Eigen::Vector3d area_vector(std::size_t triangle) const {
    return 0.5 * (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0));
  }
};

}  // namespace pelagos
