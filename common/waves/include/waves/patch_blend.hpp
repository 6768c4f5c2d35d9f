#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace pelagos {

/// Waves shorter than this many spacings are not carried by particles: they stay outside a patch, and are drawn on it.
inline constexpr double kShortestParticleWave = 8.0;

/// How the surface passes at the edges of the patch from the wave field, outside, to the particles, inside. The shaders
/// take `start` and `full` from here and have the same formula (patch_weight in common.glsl).
struct PatchBlend {
  double start = 0.0;  ///< m inside the nearest edge: up to here the wave field holds alone
  double full = 0.0;   ///< m inside the nearest edge, >= start: from here on the particles do
};

/// The blend over the rim of a patch whose edges are open, or are to look so: from 2 d to 14 d inside the edge, less in
/// a patch that is narrow.
/// @param spacing  m, d   @param narrow_side  m, the shorter horizontal side of the patch
[[nodiscard]] inline PatchBlend rim_blend(double spacing, double narrow_side) {
  return {std::min(2.0 * spacing, 0.05 * narrow_side), std::min(14.0 * spacing, 0.25 * narrow_side)};
}

/// The particles' share of the surface, 0..1: smoothstep over the distance to the nearest edge. A blend without width
/// is a step at the edge itself, which belongs to the patch.
/// @param min, max  m, horizontal corners of the patch; place in the same frame
[[nodiscard]] inline double patch_weight(const PatchBlend& blend, const Eigen::Vector2d& min,
                                         const Eigen::Vector2d& max, const Eigen::Vector2d& place) {
  const double inside = (place - min).cwiseMin(max - place).minCoeff();
  if (!(blend.full > blend.start)) return inside >= blend.start ? 1.0 : 0.0;
  const double q = std::clamp((inside - blend.start) / (blend.full - blend.start), 0.0, 1.0);
  return q * q * (3.0 - 2.0 * q);
}

}  // namespace pelagos
