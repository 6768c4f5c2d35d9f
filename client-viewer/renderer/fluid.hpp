#pragma once

#include <span>
#include <vector>

#include "channels/camera.hpp"
#include "packing/surface_particle.hpp"
#include "renderer/gl_objects.hpp"

namespace pelagos {

/// A particle as the shaders read it (struct Particle of particle.vert).
struct DrawnParticle {
  float centre[3];  ///< m, relative to the eye
  float foam;       ///< 0..1; -1: oil, which does not foam
  float orientation[4];
  float semi_axes[3];
  float spray;  ///< 0..1
};
static_assert(sizeof(DrawnParticle) == 48);

/// Size of the fluid buffers of a channel: the picture with its guard band, at a part of its resolution.
struct FluidSize {
  int width = 1, height = 1;
  double tan_half_x = 1.0, tan_half_y = 1.0;  ///< of the guarded picture
  double focal_pixels = 1.0;
};
[[nodiscard]] FluidSize fluid_size_of(const Camera& camera, double scale);

/// Screen-space surface of the simulated patch: ellipsoids by ray-quadric intersection, foam of the front layer,
/// narrow-range smoothing, slopes.
class FluidPass {
 public:
  FluidPass(int width, int height);

  /// Passes 3 and 4: nearest ellipsoid (inverse depth) and foam. Draws all of `particles`.
  void draw_particles(std::span<const DrawnParticle> particles);
  /// Passes 5 and 6.
  void smooth();

  [[nodiscard]] const Texture& inverse_depth() const { return first_; }  ///< as drawn; after smooth(): smoothed
  [[nodiscard]] const Texture& surface() const { return surface_; }  ///< inverse depth, slope x, slope y, foam less oil
  void bind_particles() const;

 private:
  void bind_quads(std::size_t count);

  Program depth_program_, attribute_program_, smooth_program_, slope_program_;
  Texture first_, second_, attributes_, surface_;
  Framebuffer first_target_, second_target_, attribute_target_, surface_target_;
  Buffer particles_, quads_;
  VertexArray array_, nothing_;
  std::size_t quad_capacity_ = 0;
};

}  // namespace pelagos
