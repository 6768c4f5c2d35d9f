#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pelagos {

/// A surface of triangles in body axes (x forward, y port, z up), metres; corners anticlockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] const Eigen::Vector3d& corner(std::size_t triangle, std::size_t which) const {
    return vertices[triangles[triangle][which]];
  }
};

/// What came out of a mesh file: a mesh, or the reasons why it cannot be used.
struct MeshFile {
  TriangleMesh mesh;
  std::vector<std::string> faults;  ///< empty: the mesh is closed and oriented outwards
};

/// Reads the triangles of a mesh file (OBJ, STL, glTF and what else Assimp knows), all its parts together, multiplies
/// by `scale`, merges vertices closer than 1e-6 of the size, and checks the result. Axes are taken as they are in the
/// file. Never throws; at most 512 MB and four million triangles are read.
/// @param scale  metres per unit of the file, > 0
[[nodiscard]] MeshFile read_mesh(const std::string& path, double scale);

/// Merges vertices closer than `distance`.
[[nodiscard]] TriangleMesh weld_vertices(const TriangleMesh& mesh, double distance);

/// Whether the mesh encloses a body: numbers in range, no degenerate triangle, each edge between two triangles that
/// run round it in opposite ways, every closed shell facing outwards. One line for each fault, the first few of a kind
/// with the place, the rest counted. Triangles are numbered from 1.
[[nodiscard]] std::vector<std::string> find_mesh_faults(const TriangleMesh& mesh);

/// Enclosed volume, m^3, by the divergence theorem; negative where the mesh faces inwards.
[[nodiscard]] double mesh_volume(const TriangleMesh& mesh);

/// Surface area, m^2.
[[nodiscard]] double mesh_area(const TriangleMesh& mesh);

}  // namespace pelagos
