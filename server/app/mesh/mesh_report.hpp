#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

/// What a person wants to know of a mesh before a scene is made with it.
struct MeshQuestions {
  MeshOptions options;
  double spacing = 0.0;             ///< m, of the boundary samples; 0: not asked
  std::optional<double> inset;      ///< spacings; nothing: as a scene that does not say
  std::optional<double> waterline;  ///< m, z of the water in body axes
  std::optional<double> draft;      ///< m, above the lowest point
  double density = 1025.0;          ///< kg/m^3, of the water
};

/// Prints the answers. @param file  a mesh file, or a primitive as "primitive:sphere:1.5"
/// @return whether the mesh can be a body
bool report_mesh(const std::string& file, const MeshQuestions& questions, std::ostream& out);

}  // namespace pelagos
