#include "surface_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

#include "mesh_edges.hpp"

namespace pelagos {

namespace {

constexpr double kSharp = 0.34;  ///< sine of 20 degrees

Eigen::Vector3d normal_of(const TriangleMesh& mesh, std::uint32_t t) {
  return (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized();
}

/// Whether triangle b rises from a towards the side that a faces.
bool bends_inwards(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const auto& corners = mesh.triangles[a];
  std::vector<Eigen::Vector3d> shared;
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : mesh.triangles[b])
    if (std::find(corners.begin(), corners.end(), v) != corners.end())
      shared.push_back(mesh.vertices[v]);
    else
      apart = mesh.vertices[v];
  if (shared.size() != 2) return false;
  const Eigen::Vector3d edge = (shared[1] - shared[0]).normalized(), way = apart - shared[0];
  const double rise = normal_of(mesh, a).dot(way), away = (way - edge.dot(way) * edge).norm();
  return rise > kSharp * away;
}

TriangleMesh take_part(const TriangleMesh& mesh, const std::vector<std::uint32_t>& of, std::uint32_t part) {
  TriangleMesh patch;
  std::vector<std::int64_t> moved(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (of[t] != part) continue;
    auto& triangle = patch.triangles.emplace_back(mesh.triangles[t]);
    for (std::uint32_t& v : triangle) {
      if (moved[v] < 0) {
        moved[v] = static_cast<std::int64_t>(patch.vertices.size());
        patch.vertices.push_back(mesh.vertices[v]);
      }
      v = static_cast<std::uint32_t>(moved[v]);
    }
  }
  return patch;
}

}  // namespace

std::vector<TriangleMesh> smooth_patches(const TriangleMesh& mesh) {
  std::vector<EdgePair> pairs = pair_triangles(mesh, collect_edges(mesh));
  std::erase_if(pairs, [&](const EdgePair& pair) { return bends_inwards(mesh, pair.a, pair.b); });
  const MeshShells parts = find_shells(mesh.triangles.size(), pairs);
  if (parts.first.size() < 2 || parts.first.size() > kMostPatches) return {mesh};
  std::vector<TriangleMesh> patches;
  for (std::uint32_t part = 0; part < parts.first.size(); ++part) patches.push_back(take_part(mesh, parts.of, part));
  return patches;
}

}  // namespace pelagos
