#pragma once

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

/// Below this share of a mesh's size squared an area counts as none.
constexpr double kLeastArea = 1e-12;

/// Mends triangles whose three corners lie on one line. Programs write them where a vertex stands in the middle of a
/// neighbour's edge, to close the gap of no width there. The neighbour is cut in two at that vertex in their place, so
/// the surface stays where it is. One that cannot be mended so stays, for find_mesh_faults to name. Other triangles are
/// left as they are, to the bit.
void mend_flat_triangles(TriangleMesh& mesh, MeshOrigin& origin);

}  // namespace pelagos
