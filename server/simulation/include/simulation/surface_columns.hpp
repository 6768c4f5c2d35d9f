#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "physics/fluid.hpp"

namespace pelagos {

/// Where to look.
struct SurfacePlace {
  Eigen::Vector2d local = Eigen::Vector2d::Zero();  ///< m, x and y
  std::optional<double>
      height;  ///< m, local z: where the velocity is wanted, if it is under water; else at the surface
};

/// The water's surface at a place in the horizontal plane.
struct SurfaceReading {
  bool wet = false;                                    ///< false: no water there, and the rest means nothing
  double height = 0.0;                                 ///< m, local
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, out of the water
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, of the water there
};

/// Measures the surface by volume: around each place stands a column of water with soft sides (weight
/// (1 - r^2 / R^2)^2, R = 2 d), and what its particles above a level deep enough take up, V each, is the height of the
/// surface above that level. How full of water the column is (walls, hulls) comes from the slab of 2 d below it. So the
/// height has no bias from how particles happen to lie at the surface: still water reads its volume over its area,
/// where the highest particle plus d / 2 reads 0.3 d too high. Waves are smoothed by the column: by 0.3 % at a length
/// of 60 d, 2.5 % at 20 d. The normal comes from the column's first moments, the velocity is the mean of its
/// topmost 1.5 d, or within 2 d of a place under water. Where the water is less than 4 d deep the column below the
/// surface is taken as it is. One pass over the particles, whatever the number of places.
[[nodiscard]] std::vector<SurfaceReading> read_surface(const FluidState& fluid, std::span<const SurfacePlace> places);

}  // namespace pelagos
