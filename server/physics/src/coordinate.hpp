#pragma once

#include <cstddef>

#include "physics/particles.hpp"

namespace pelagos {

/// x, y or z of a record, by axis.
[[nodiscard]] inline float coordinate(const Float4& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}
[[nodiscard]] inline float& coordinate(Float4& p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace pelagos
