#pragma once

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// Share of the volume of its convex hull that a closed mesh leaves empty, 0 to 1: 0 for a convex mesh, 0.51 for a dock
/// that is a thin U. By Bullet's convex hull (Preparata and Hong 1977). 0 for a mesh without volume.
[[nodiscard]] double hollow_share(const TriangleMesh& mesh);

}  // namespace pelagos
