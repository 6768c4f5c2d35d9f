#pragma once

#include "renderer/gl_objects.hpp"

namespace pelagos {

/// Pictures that are made once: the sky, and the foam pattern, which tiles seamlessly.
class DetailTextures {
 public:
  /// The view block must be bound and hold the sun.
  DetailTextures();

  [[nodiscard]] const Texture& sky() const { return sky_; }  ///< see sky_place of common.glsl; HDR, mip chain
  [[nodiscard]] const Texture& foam() const {
    return foam_;
  }  ///< strands and holes; threads along x; both spread evenly over 0..1

 private:
  Texture sky_, foam_;
};

/// Length in metres after which the patterns of foam repeat, in axes along and across its streaks.
inline constexpr double kDetailPeriod = 60.0;

}  // namespace pelagos
