#include "physics/solid_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pelagos {

namespace {

/// Where directions have cancelled out to less than this, no surface is the nearest.
constexpr float kLeastNormal = 0.3F;
/// No place of a cell is farther from a node of it than its diagonal.
constexpr float kDiagonal = 1.7321F;

/// A place in a cell: from the first node, in cells.
struct InCell {
  std::array<float, 3> t;
  float cell;  ///< m
};

Float4 mix(const Float4& a, const Float4& b, float t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.w + t * (b.w - a.w)};
}
Float4 less(const Float4& a, const Float4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }

/// The normal at a node, and s + n.r / 2 with r the way from the node to the place.
Float4 half_way(const Float4& node, const InCell& at, float i, float j, float k) {
  const float along = node.x * (at.t[0] - i) + node.y * (at.t[1] - j) + node.z * (at.t[2] - k);
  return {node.x, node.y, node.z, node.w + 0.5F * at.cell * along};
}

/// s = sum w_i (s_i + n_i.(x - x_i) / 2) over the nodes i of a cell, with weights w_i that are linear along each axis:
/// exact where the distance is quadratic in space. The normal is the gradient of s.
Float4 interpolate(const Float4* v, std::size_t row, std::size_t layer, const InCell& at) {
  std::array<Float4, 8> m;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner & 1U, j = corner >> 1U & 1U, k = corner >> 2U;
    m[corner] =
        half_way(v[i + j * row + k * layer], at, static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
  }
  const auto [tx, ty, tz] = at.t;
  const Float4 a = mix(m[0], m[1], tx), b = mix(m[2], m[3], tx), c = mix(m[4], m[5], tx), d = mix(m[6], m[7], tx);
  const Float4 lower = mix(a, b, ty), upper = mix(c, d, ty), middle = mix(lower, upper, tz);
  const float along_z = less(upper, lower).w;
  const float along_y = mix(less(b, a), less(d, c), tz).w;
  const float along_x =
      mix(mix(less(m[1], m[0]), less(m[3], m[2]), ty), mix(less(m[5], m[4]), less(m[7], m[6]), ty), tz).w;
  return {0.5F * middle.x + along_x / at.cell, 0.5F * middle.y + along_y / at.cell, 0.5F * middle.z + along_z / at.cell,
          middle.w};
}

}  // namespace

std::optional<Float4> SolidField::at(float x, float y, float z, float reach) const {
  const float place[3] = {(x - origin[0]) / cell, (y - origin[1]) / cell, (z - origin[2]) / cell};
  std::size_t first[3];
  InCell in{{}, cell};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Written so that NaN is outside.
    if (!(place[axis] >= 0.0F && place[axis] <= static_cast<float>(nodes[axis] - 1))) return std::nullopt;
    const int node = std::min(static_cast<int>(place[axis]), nodes[axis] - 2);
    first[axis] = static_cast<std::size_t>(node);
    in.t[axis] = place[axis] - static_cast<float>(node);
  }
  const auto row = static_cast<std::size_t>(nodes[0]), layer = row * static_cast<std::size_t>(nodes[1]);
  const Float4* v = &values[first[2] * layer + first[1] * row + first[0]];
  if (!(v->w < reach + kDiagonal * cell)) return std::nullopt;  // no distance changes faster than the way
  Float4 found = interpolate(v, row, layer, in);
  if (!(found.w < reach)) return std::nullopt;
  const float length = std::sqrt(found.x * found.x + found.y * found.y + found.z * found.z);
  if (!(length > kLeastNormal)) return std::nullopt;
  found.x /= length, found.y /= length, found.z /= length;
  return found;
}

}  // namespace pelagos
