#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "text/refusal.hpp"

namespace pelagos {

/// What is read of a mesh file at most. A file that has more is refused with these numbers, before the memory is taken.
struct MeshLimits {
  static constexpr std::size_t kBytes = std::size_t{128} << 20;  ///< of the file and those that it refers to, together
  static constexpr std::size_t kTriangles = 500'000;
  static constexpr std::size_t kVertices = 1'500'000;
  static constexpr std::size_t kParts = 10'000;  ///< objects, groups, solids, meshes at nodes
  static constexpr std::size_t kMaterials = 10'000;
  static constexpr std::size_t kCorners = 4'096;     ///< of one polygon
  static constexpr std::size_t kLines = 10'000'000;  ///< of text
  static constexpr std::size_t kLine = 1u << 20;     ///< characters of a line of text
  static constexpr std::size_t kJsonDepth = 64;      ///< brackets inside each other
  static constexpr std::size_t kJsonValues = 1'000'000;
  static constexpr std::size_t kNodeDepth = 256;  ///< nodes below each other
};

/// A part of a mesh file: an object or group (OBJ), a solid (STL), a primitive of a mesh at a node (glTF).
struct ImportedPart {
  std::string name;   ///< in words, as `object "hull"`; empty where the file gives no name and has no other part
  std::string place;  ///< what ImportedTriangle::place counts: "the face at line", "facet", "triangle"
};

struct ImportedTriangle {
  std::array<std::uint32_t, 3> corners;  ///< vertices, all different, anticlockwise seen from outside
  std::uint32_t part;                    ///< index into ImportedMesh::parts
  std::uint32_t place;                   ///< where the file has it, from 1; the triangles of a polygon share it
  std::uint32_t material;                ///< index into ImportedMesh::materials
};

struct ImportedMaterial {
  std::string name;
  std::array<float, 3> colour;  ///< Kd of OBJ as written; base colour of glTF, linear
};

/// What came out of a mesh file, or the reason why it is refused.
struct ImportedMesh {
  std::vector<Eigen::Vector3d> vertices;    ///< finite; the file's units and axes, its nodes' transforms applied
  std::vector<ImportedTriangle> triangles;  ///< in the order of the file
  std::vector<ImportedPart> parts;          ///< in the order of their first triangle
  std::vector<ImportedMaterial> materials;  ///< the first is for triangles without one: grey
  std::vector<std::string> notes;           ///< what was ignored and may surprise, a line each
  Refusals faults;                          ///< not empty: refused, and there are no triangles; without the file's name
};

struct ImportOptions {
  /// Whether colours are wanted: reads the material libraries of an OBJ file that lie in its own folder or below.
  /// Others are not opened, and those that are missing leave the triangles grey; both are noted.
  bool materials = false;
};

/// Reads the triangles of a mesh file: .obj, .stl (text or binary), .gltf or .glb. Never throws, and starts nothing.
///
/// Bounded: time grows with the size of the file, which is bounded by MeshLimits, and no count that the file states is
/// trusted before it has been compared with the bytes that are there. A file is refused within a second and 256 MB on
/// a machine of today. Files that it refers to (glTF buffers, material libraries) are opened only if they lie in the
/// mesh's own folder or below, links resolved.
///
/// Written here and not left to Assimp: its importers (5.2, of Debian 12) recurse as deep as a file says, take time
/// that grows with the square of counts and memory before any limit can be set, read 1,5 as 1.5, turn mirrored nodes
/// inside out and forget lines. Bounding them takes a parser of each format in front and a process around. JSON is left
/// to a library.
///
/// Polygons are cut into triangles that have an area each and use every corner, so that a corner in the middle of an
/// edge leaves no gap to the neighbours there. Vertices are as the file has them: which of them are one point is for
/// the caller to say (weld_vertices), for normals too. Binary STL has no shared vertices: equal ones are one here.
/// Nodes that mirror have the order of their corners turned.
[[nodiscard]] ImportedMesh import_mesh(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace pelagos
