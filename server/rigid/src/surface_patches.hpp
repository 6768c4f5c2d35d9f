#pragma once

#include <vector>

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// The parts of a surface that nowhere bend sharply towards the water: cut along edges at which the water has less than
/// about 160 degrees. Such an inner edge is where two surfaces meet that water near it has both in reach. A surface
/// that would come to more than kMostPatches parts, as rough ground does, stays whole.
[[nodiscard]] std::vector<TriangleMesh> smooth_patches(const TriangleMesh& mesh);

inline constexpr std::size_t kMostPatches = 16;

}  // namespace pelagos
