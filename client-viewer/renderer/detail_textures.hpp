#pragma once

#include "renderer/gl_objects.hpp"

namespace pelagos {

/// Pictures that are made once: the sky, ripple slopes and the foam pattern. All but the sky tile seamlessly.
class DetailTextures {
 public:
  /// The view block must be bound and hold the sun.
  DetailTextures();

  [[nodiscard]] const Texture& sky() const { return sky_; }          ///< azimuth x sqrt(elevation), HDR, mip chain
  [[nodiscard]] const Texture& ripples() const { return ripples_; }  ///< slopes x, y and their squared length
  [[nodiscard]] const Texture& foam() const { return foam_; }        ///< lacy pattern, 0..1

 private:
  Texture sky_, ripples_, foam_;
};

/// Length in metres after which all tiles of ripples and foam repeat.
inline constexpr double kDetailPeriod = 240.0;

}  // namespace pelagos
