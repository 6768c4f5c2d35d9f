#pragma once

#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

/// A surface under all water that may bend and move: the bed of a sea, or the lower side of the water that is simulated
/// of a deeper one. The water meets it as it meets solids (physics/solids.hpp), by the tangent plane at the nearest
/// place.
struct Floor {
  float x = 0.0F, y = 0.0F;   ///< m, local: of the first node
  float cell = 1.0F;          ///< m, between nodes
  int columns = 0, rows = 0;  ///< nodes along x, along y; at least 2 each, or 0: no floor
  /// [y][x] x: height, m, local; y, z: its slopes along x and y; w: how fast it rises at that place, m/s.
  std::vector<Float4> nodes;

  [[nodiscard]] bool empty() const { return nodes.empty(); }
  /// Height, slopes and rise at a place, as in `nodes`. Between nodes the height is exact where it is quadratic.
  /// The slopes are those of the height. Beyond the outer nodes: as at the nearest place between them.
  [[nodiscard]] Float4 at(float x, float y) const;
};

/// The tangent plane of a floor at the place nearest to a particle.
struct FloorPlane {
  Float4 surface;      ///< x, y, z: unit normal, upwards; w: the particle's distance, m, negative below
  float speed = 0.0F;  ///< m/s, of the floor along the normal
};
[[nodiscard]] FloorPlane floor_plane(const Floor& floor, const Float4& place);

}  // namespace pelagos
