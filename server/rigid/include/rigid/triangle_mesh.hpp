#pragma once

#include <span>
#include <string>
#include <vector>

#include "shapes/mesh_name.hpp"
#include "shapes/triangle_mesh.hpp"
#include "text/refusal.hpp"

namespace pelagos {

/// Whether a mesh encloses a body, or is one side of something larger, as a sea bed is.
enum class MeshKind {
  kClosed,  ///< every edge between two triangles
  kOpen,    ///< may end at a rim; what lies behind its faces is solid
};

/// How a mesh file is to be understood.
struct MeshOptions {
  double scale = 1.0;  ///< metres per unit of the file, > 0
  MeshAxes axes = MeshAxes::kXForwardZUp;
  MeshKind kind = MeshKind::kClosed;
};

/// Where the triangles of a mesh stand in its file, to say it to a person. Empty: the mesh came from no file.
struct MeshOrigin {
  std::vector<std::string> parts;       ///< of the file, in words: an object, a solid, a node with its mesh
  std::vector<std::uint32_t> part;      ///< [triangles] index into `parts`
  std::vector<std::string> place_name;  ///< [parts] what `place` counts: "face", "facet", "triangle"
  std::vector<std::uint32_t> place;     ///< [triangles] from 1, as the file counts

  /// "face 12 of object \"hull\""; without an origin "triangle 12", counted from 1.
  [[nodiscard]] std::string describe(std::size_t triangle) const;
};

/// What came out of a mesh file: a mesh, or the reasons why it cannot be used.
struct MeshFile {
  TriangleMesh mesh;  ///< parts that are closed by themselves share no vertex with any other part
  Refusals faults;    ///< empty: the mesh passes find_mesh_faults
  MeshOrigin origin = {};
  std::vector<std::string> notes = {};  ///< what of the file was ignored and may surprise
};

/// Reads the triangles of a mesh file with import_mesh, all its parts together, multiplies by the scale, turns them
/// into body axes, merges vertices closer than 1e-6 of the size, and checks the result. Vertices are merged within a
/// part that is closed by itself, so that parts which touch stay apart; the other parts, as the patches of one hull
/// are, are merged with each other. Triangles that vanish by that are left out, flat ones and gaps without width are
/// mended. Never throws; bounded by MeshLimits.
[[nodiscard]] MeshFile read_mesh(const std::string& path, const MeshOptions& options = {});

/// Merges vertices closer than `distance`. Triangles keep their order, vertices that of their first use in the list.
[[nodiscard]] TriangleMesh weld_vertices(const TriangleMesh& mesh, double distance);

/// The same part by part, see read_mesh.
/// @param part  [triangles] number of the part that each triangle belongs to
[[nodiscard]] TriangleMesh weld_parts(const TriangleMesh& mesh, std::span<const std::uint32_t> part, double distance);

/// Whether the mesh can be a body: numbers in range, no degenerate triangle, each edge between two triangles that run
/// round it in opposite ways (or at the rim of an open mesh), every part facing outwards or a cavity of others
/// (unite_parts). Where parts touch, an edge may have more triangles, as many along as back. One line for each fault,
/// the first few of a kind with the place, the rest counted. Triangles are named by their origin, or numbered from
/// 1. Whether the surface cuts itself is another question: MeshQuery::find_self_intersections.
[[nodiscard]] Refusals find_mesh_faults(const TriangleMesh& mesh, MeshKind kind = MeshKind::kClosed,
                                        const MeshOrigin& origin = {});

/// Enclosed volume, m^3, by the divergence theorem; negative where the mesh faces inwards.
[[nodiscard]] double mesh_volume(const TriangleMesh& mesh);

/// Surface area, m^2.
[[nodiscard]] double mesh_area(const TriangleMesh& mesh);

/// The edges at the rim of an open mesh: those that one triangle has, from the lower to the higher vertex.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> rim_edges(const TriangleMesh& mesh);

}  // namespace pelagos
