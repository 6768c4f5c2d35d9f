#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "rigid/triangle_mesh.hpp"

namespace pelagos::test {

/// Box between two corners, twelve triangles facing outwards.
inline TriangleMesh make_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.vertices.emplace_back(n & 1 ? high.x() : low.x(), n & 2 ? high.y() : low.y(), n & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Sphere of latitude rings, facing outwards.
inline TriangleMesh make_sphere(double radius, std::uint32_t rings) {
  TriangleMesh mesh;
  const std::uint32_t sectors = 2 * rings;
  mesh.vertices.emplace_back(0, 0, -radius);
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const double polar = std::numbers::pi * i / rings, azimuth = 2 * std::numbers::pi * j / sectors;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::cos(azimuth),
                                 radius * std::sin(polar) * std::sin(azimuth), -radius * std::cos(polar));
    }
  mesh.vertices.emplace_back(0, 0, radius);
  const auto ring = [&](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * sectors + j % sectors; };
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t j = 0; j < sectors; ++j) {
    mesh.triangles.push_back({0, ring(1, j + 1), ring(1, j)});
    mesh.triangles.push_back({top, ring(rings - 1, j), ring(rings - 1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({ring(i, j), ring(i, j + 1), ring(i + 1, j)});
      mesh.triangles.push_back({ring(i, j + 1), ring(i + 1, j + 1), ring(i + 1, j)});
    }
  }
  return mesh;
}

/// The triangles of all.
inline TriangleMesh joined(std::initializer_list<TriangleMesh> meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

}  // namespace pelagos::test
