#pragma once

#include <span>
#include <string>
#include <unordered_map>

#include "mesh_import/import_mesh.hpp"

namespace pelagos {

/// What goes with a triangle.
struct TriangleTags {
  std::uint32_t part = 0, place = 0, material = 0;
};

/// Collects a mesh within MeshLimits; what goes beyond them throws an ImportFault that names them.
class MeshBuilder {
 public:
  MeshBuilder();

  /// The part of this name, a new one the first time.
  [[nodiscard]] std::uint32_t part(const std::string& name, const std::string& place);
  /// The material of this name, a new grey one the first time.
  [[nodiscard]] std::uint32_t material(const std::string& name);
  [[nodiscard]] ImportedMaterial* find_material(const std::string& name);

  void add_vertex(const Eigen::Vector3d& vertex);
  /// The vertex at exactly this point, a new one the first time.
  [[nodiscard]] std::uint32_t shared_vertex(const Eigen::Vector3d& vertex);
  [[nodiscard]] std::size_t vertices() const { return mesh_.vertices.size(); }
  /// Takes room for vertices and triangles still to come.
  void expect(std::size_t vertices, std::size_t triangles);

  /// Dropped if two corners are one vertex: its neighbours meet where it was.
  void add_triangle(const std::array<std::uint32_t, 3>& corners, const TriangleTags& tags);
  /// Dropped if fewer than three different corners are left.
  /// @param name  of the polygon, for messages: "the face at line 7"
  void add_polygon(std::span<const std::uint32_t> corners, const TriangleTags& tags, const std::string& name);

  void add_note(const std::string& note) { mesh_.notes.push_back(note); }
  [[nodiscard]] ImportedMesh take() { return std::move(mesh_); }

 private:
  /// Takes corners into the ring, each point once in a row, without edges that lead there and back again.
  void make_ring(std::span<const std::uint32_t> corners);
  /// Where a point is in the hash, or would be.
  [[nodiscard]] std::size_t place_of(const Eigen::Vector3d& vertex) const;

  ImportedMesh mesh_;
  std::unordered_map<std::string, std::uint32_t> parts_, materials_;
  std::vector<std::uint32_t> shared_;  ///< vertices in a hash by their point, at most half of it taken
  std::size_t shared_count_ = 0;
  std::uint64_t work_ = 0;  ///< comparisons while cutting polygons
  std::vector<std::uint32_t> ring_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint32_t, 3>> cut_;
};

/// @throws ImportFault if there are more triangles, or more vertices, than are read
void check_triangles(std::size_t count);
void check_vertices(std::size_t count);
/// @throws ImportFault if a polygon has more corners than are read
void check_corners(std::size_t count, const std::string& name);

}  // namespace pelagos
