#pragma once

#include <algorithm>
#include <limits>

#include "values/scene.hpp"

namespace pelagos {

/// Columns of particles at open edges that move as the waves say.
inline constexpr int kRimColumns = 3;

/// m, from the nearest open edge of a patch inwards; negative beyond it. Large without open edges. @param place  m, as
/// box
[[nodiscard]] inline double distance_inside(const Box& patch, const PatchEdges& edges, const Eigen::Vector2d& place) {
  double least = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 2; ++axis)
    if (edges[static_cast<std::size_t>(axis)] == PatchEdge::kOpen)
      least = std::min({least, place[axis] - patch.min[axis], patch.max[axis] - place[axis]});
  return least;
}

}  // namespace pelagos
