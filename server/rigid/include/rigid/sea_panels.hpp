#pragma once

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// A coarse closed surface of a body, over which the pressure of a sea is integrated. Body axes.
struct SeaPanels {
  TriangleMesh mesh;
  double edge = 0.0;  ///< m, about the length of an edge
};

/// Panels of a closed mesh: long edges are halved, and a mesh of more than some 2,000 triangles is made coarser by
/// vertex clustering (Rossignac and Borrel 1993), at the mean of the vertices of a cell. Then it is scaled about the
/// centre of its volume, so that it encloses exactly as much as the mesh. The surface stays closed. Some 600 panels on
/// a simple shape.
/// @param mesh  closed, without faults
[[nodiscard]] SeaPanels make_sea_panels(const TriangleMesh& mesh);

}  // namespace pelagos
