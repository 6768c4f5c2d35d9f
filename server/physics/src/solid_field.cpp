#include "physics/solid_field.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

/// Where directions have cancelled out to less than this, no surface is the nearest.
constexpr float kLeastNormal = 0.3F;

Float4 mix(const Float4& a, const Float4& b, float t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.w + t * (b.w - a.w)};
}

}  // namespace

std::optional<Float4> SolidField::at(float x, float y, float z, float reach) const {
  const float place[3] = {(x - origin[0]) / cell, (y - origin[1]) / cell, (z - origin[2]) / cell};
  std::size_t first[3];
  float rest[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Written so that NaN is outside.
    if (!(place[axis] >= 0.0F && place[axis] <= static_cast<float>(nodes[axis] - 1))) return std::nullopt;
    const int node = std::min(static_cast<int>(place[axis]), nodes[axis] - 2);
    first[axis] = static_cast<std::size_t>(node);
    rest[axis] = place[axis] - static_cast<float>(node);
  }
  const auto row = static_cast<std::size_t>(nodes[0]), layer = row * static_cast<std::size_t>(nodes[1]);
  const Float4* v = &values[first[2] * layer + first[1] * row + first[0]];
  // No distance changes faster than the way, and no place of a cell is farther from its node than its diagonal.
  constexpr float kDiagonal = 1.7321F;
  if (!(v->w < reach + kDiagonal * cell)) return std::nullopt;
  const auto along_x = [&](const Float4* at) { return mix(at[0], at[1], rest[0]); };
  const Float4 lower = mix(along_x(v), along_x(v + row), rest[1]);
  const Float4 upper = mix(along_x(v + layer), along_x(v + layer + row), rest[1]);
  Float4 found = mix(lower, upper, rest[2]);
  if (!(found.w < reach)) return std::nullopt;
  const float length = std::sqrt(found.x * found.x + found.y * found.y + found.z * found.z);
  if (!(length > kLeastNormal)) return std::nullopt;
  found.x /= length, found.y /= length, found.z /= length;
  return found;
}

}  // namespace pelagos
