#pragma once

#include "meshes/mesh_data.hpp"

namespace pelagos {

/// Whether a tank of that size (m) has walls of glass; larger ones have walls of concrete.
[[nodiscard]] bool has_glass_walls(const Eigen::Vector3d& size);

/// The walls of a patch and what they stand on, about its inner box: the floor at z = 0, corner in the origin. Glass
/// itself is no part of it, only the frame that holds it. Concrete walls end `wall` m above the floor.
/// @param size  m, of the inner box
[[nodiscard]] MeshData draw_tank(const Eigen::Vector3d& size, double wall);

}  // namespace pelagos
