#pragma once

#include "renderer/gl_objects.hpp"

namespace pelagos {

/// The sky, drawn when the light changes, and the foam pattern, which is made once and tiles seamlessly.
class DetailTextures {
 public:
  DetailTextures();
  /// The view block must be bound and hold sun and weather.
  void draw_sky();

  [[nodiscard]] const Texture& sky() const { return sky_; }  ///< see sky_place of common.glsl; HDR, mip chain
  [[nodiscard]] const Texture& foam() const {
    return foam_;
  }  ///< strands and holes; threads along x; both spread evenly over 0..1

 private:
  Program sky_program_;
  Texture sky_, foam_;
  Framebuffer target_;
  VertexArray nothing_;
};

/// Length in metres after which the patterns of foam repeat, in axes along and across its streaks.
inline constexpr double kDetailPeriod = 180.0;

}  // namespace pelagos
