#include "physics/floor.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

/// The node before a place along one axis, and how far on the place is, 0..1.
struct Step {
  int node = 0;
  float part = 0.0F;
};
Step step_along(float way, float cell, int nodes) {
  const float at = std::clamp(way / cell, 0.0F, static_cast<float>(nodes - 1));
  const int node = std::min(static_cast<int>(at), nodes - 2);
  return {node, at - static_cast<float>(node)};
}

}  // namespace

Float4 Floor::at(float place_x, float place_y) const {
  const Step a = step_along(place_x - x, cell, columns), b = step_along(place_y - y, cell, rows);
  const float half = 0.5F * cell;
  Float4 sum{};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const Float4& node = nodes[static_cast<std::size_t>(b.node + j) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(a.node + i)];
      const float along = i == 0 ? 1.0F - a.part : a.part, across = j == 0 ? 1.0F - b.part : b.part;
      const float weight = along * across;
      const float way_x = a.part - static_cast<float>(i), way_y = b.part - static_cast<float>(j);
      const float height = node.x + half * (way_x * node.y + way_y * node.z);
      sum.x += weight * height;
      sum.y += 0.5F * weight * node.y + (i == 0 ? -across : across) * height / cell;
      sum.z += 0.5F * weight * node.z + (j == 0 ? -along : along) * height / cell;
      sum.w += weight * node.w;
    }
  return sum;
}

FloorPlane floor_plane(const Floor& floor, const Float4& place) {
  // The tangent plane straight above or below, then the one at the foot of the normal on it: the distance is that to
  // the surface, and the normal is its gradient, up to terms of curvature squared.
  constexpr int kSteps = 2;
  float x = place.x, y = place.y;
  FloorPlane plane;
  for (int step = 0; step < kSteps; ++step) {
    const Float4 at = floor.at(x, y);
    const float up = 1.0F / std::sqrt(1.0F + at.y * at.y + at.z * at.z);
    const float nx = -up * at.y, ny = -up * at.z;
    const float distance = nx * (place.x - x) + ny * (place.y - y) + up * (place.z - at.x);
    plane = {{nx, ny, up, distance}, up * at.w};
    x = place.x - distance * nx, y = place.y - distance * ny;
  }
  return plane;
}

}  // namespace pelagos
