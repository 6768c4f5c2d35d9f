#pragma once

#include <Eigen/Core>
#include <array>

namespace pelagos {

/// The uniform block `View` of common.glsl, field by field (std140: vectors of four floats only).
struct ViewBlock {
  Eigen::Vector4f right, up, forward, size, fluid_size, fluid, level, patch_box, patch_blend, sun, sunlight, weather,
      wave_axis, pattern, sea_grid;
  std::array<Eigen::Vector4f, 3> tile;
  std::array<Eigen::Vector4f, 4> hull, hull_size;
  std::array<Eigen::Vector4f, 3> shadow;
  Eigen::Vector4f slick_map, slick_centre;
  std::array<Eigen::Vector4f, 2> foam_map, foam_window;
  Eigen::Vector4f foam_left;
};
static_assert(sizeof(ViewBlock) == 36 * 4 * sizeof(float));

}  // namespace pelagos
