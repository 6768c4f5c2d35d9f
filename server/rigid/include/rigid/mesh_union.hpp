#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

/// What a part of a mesh, a connected shell, is to the solid that all of them make.
enum class PartRole {
  kSolid,      ///< faces outwards
  kCavity,     ///< faces inwards and lies in solid parts: what it encloses is taken out of them
  kSwallowed,  ///< faces outwards, but all of it is solid by other parts already: it adds nothing
};

struct MeshPart {
  std::size_t first_triangle = 0;  ///< its first one in the mesh
  std::size_t triangles = 0;
  double volume = 0.0;  ///< m^3, enclosed; negative where it faces inwards
  PartRole role = PartRole::kSolid;
  bool sealed = false;  ///< a cavity that no water can reach: it stays dry, and displaces water as the solid around it
};

/// The solid that the parts of a closed mesh make together.
struct MeshUnion {
  /// Its boundary. The mesh that was given, bit for bit, where no part loses any of its surface. Otherwise a cover of
  /// the boundary by triangles that may end in the middle of each other's edges: right for volumes, areas, distances,
  /// rays and samples, but its edges are not those of two triangles.
  TriangleMesh mesh;
  /// What the sea meets: the same with sealed cavities, and all that is in them, as if they were solid. Nothing where
  /// there are none.
  std::optional<TriangleMesh> outer;
  std::vector<MeshPart> parts;      ///< in the order of their first triangles
  std::vector<std::uint32_t> part;  ///< [triangles of the mesh that was given] index into `parts`
  std::vector<std::string> notes;   ///< what a person should know: cavities, parts that add nothing, overlap
  Refusals faults;                  ///< not empty: there is no such solid, and what to do

  [[nodiscard]] const TriangleMesh& outside() const { return outer ? *outer : mesh; }
};

/// Unites the parts of a closed mesh: solids that overlap, touch or nest, less their cavities. Inside is where the
/// winding number of all parts is at least 1 (Jacobson et al. 2013, "Robust inside-outside segmentation using
/// generalized winding numbers"). A part that reaches into a cavity fills it there.
/// Each face that another part comes near to is cut along that part's section with the face's plane; winding numbers
/// just above and just below decide what stays (cut_face). Faces closer than 2e-6 of the mesh's size lie on one
/// another. Faces that nothing comes near to are decided together, as far as they are connected.
/// Refused: parts that face inwards and are no cavity, parts without volume, and parts that cross each other too often
/// (some hundred million steps, about a second).
/// @param mesh    closed, without faults of its edges
/// @param origin  to name triangles in notes and faults
[[nodiscard]] MeshUnion unite_parts(const TriangleMesh& mesh, const MeshOrigin& origin = {});

}  // namespace pelagos
