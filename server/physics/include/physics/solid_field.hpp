#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

/// The surface of a solid as a distance field: at the nodes of a regular grid, in the solid's own axes, the signed
/// distance to the surface and the direction away from it. Between nodes it is exact where it is quadratic in
/// space, and its gradient gives the direction.
struct SolidField {
  std::array<float, 3> origin{};  ///< m, of the first node
  float cell = 1.0F;              ///< m, between nodes
  std::array<int, 3> nodes{};     ///< along x, y, z
  std::vector<Float4> values;     ///< [z][y][x]: x, y, z: unit normal into the water; w: distance, m, negative inside

  /// Normal and distance at a place less than `reach` from the surface or inside; none elsewhere, outside the grid, and
  /// where directions cancel out far inside.
  [[nodiscard]] std::optional<Float4> at(float x, float y, float z, float reach) const;
  /// m, the last node along an axis.
  [[nodiscard]] float end(std::size_t axis) const { return origin[axis] + cell * static_cast<float>(nodes[axis] - 1); }
};

}  // namespace pelagos
