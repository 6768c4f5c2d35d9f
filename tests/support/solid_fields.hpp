#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>

#include "physics/grid.hpp"
#include "physics/solid_field.hpp"

namespace pelagos::test {

/// A field over `region` from a function that gives normal (x, y, z) and distance (w) at a place.
inline std::shared_ptr<const SolidField> make_field(const Region& region, double cell,
                                                    const std::function<Float4(double, double, double)>& surface) {
  auto field = std::make_shared<SolidField>();
  field->cell = static_cast<float>(cell);
  std::array<int, 3>& n = field->nodes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    field->origin[axis] = region.min[axis];
    n[axis] = static_cast<int>(std::ceil(static_cast<double>(region.max[axis] - region.min[axis]) / cell)) + 1;
  }
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        field->values.push_back(surface(static_cast<double>(field->origin[0]) + i * cell,
                                        static_cast<double>(field->origin[1]) + j * cell,
                                        static_cast<double>(field->origin[2]) + k * cell));
  return field;
}

/// A floor: the half space below `height`.
inline std::shared_ptr<const SolidField> floor_field(const Region& region, double cell, double height) {
  return make_field(region, cell, [&](double, double, double z) {
    return Float4{0, 0, 1, static_cast<float>(z - height)};
  });
}

/// A ball about its own origin.
inline std::shared_ptr<const SolidField> ball_field(double radius, double reach, double cell) {
  const auto half = static_cast<float>(radius + reach);
  return make_field(Region{{-half, -half, -half}, {half, half, half}}, cell, [&](double x, double y, double z) {
    const double r = std::max(std::sqrt(x * x + y * y + z * z), 1e-9);
    return Float4{static_cast<float>(x / r), static_cast<float>(y / r), static_cast<float>(z / r),
                  static_cast<float>(r - radius)};
  });
}

}  // namespace pelagos::test
