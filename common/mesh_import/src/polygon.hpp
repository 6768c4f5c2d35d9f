#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pelagos {

/// Cuts a polygon into triangles, anticlockwise as the polygon is, that use every corner and of which none is flat
/// unless the whole polygon is. By ear clipping in the plane that the polygon faces (Newell's normal): corners in the
/// middle of an edge are corners, and may lie on no cut. Time grows with corners times concave corners.
/// @param corners    at least three, of which no two neighbours are the same point
/// @param triangles  out: indices into corners; two less than corners
/// @param work       is counted up by the number of comparisons
/// @return false if the polygon crosses itself, so that there is no such cut
[[nodiscard]] bool cut_polygon(std::span<const Eigen::Vector3d> corners,
                               std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint64_t& work);

}  // namespace pelagos
