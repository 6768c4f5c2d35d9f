#pragma once

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

/// Closes gaps without width: where an edge of one triangle only has vertices of other such edges on it, as programs
/// leave them that divide a side more finely than its neighbour, the triangle is divided at those vertices. No vertex
/// moves, and triangles without such an edge stay as they are, to the bit. A mesh with more than 50,000 such edges is
/// left alone.
/// @param distance  m, from the edge, up to which a vertex lies on it
void divide_at_rim_points(TriangleMesh& mesh, MeshOrigin& origin, double distance);

}  // namespace pelagos
