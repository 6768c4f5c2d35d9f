#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "renderer/gl_objects.hpp"
#include "renderer/opaque.hpp"

namespace pelagos {

/// Where the map of shadows lies: the rows `shadow` of the view block. Places are relative to the eye.
struct ShadowPlace {
  Eigen::Vector4d u = {0, 0, 0, -1}, v = {0, 0, 0, -1};  ///< to texture coordinates; outside 0..1 all is lit
  double bias = 0.0;                                     ///< m
  double middle = 0.0;                                   ///< m, along the way to the sun
  double scale = 0.0;                                    ///< 1/m: depths of the map a metre
};
/// A square about the bodies within 250 m of the eye, across the sun's rays; without such bodies nothing.
/// @param texels  of a side of the map
[[nodiscard]] ShadowPlace shadow_place(const std::vector<PlacedMesh>& meshes, const Eigen::Vector3d& sun, int texels);

/// The bodies as the sun sees them: how far towards it the first of them lies.
class ShadowPass {
 public:
  explicit ShadowPass(int texels);
  /// The view block must be bound.
  void draw(const std::vector<PlacedMesh>& meshes);

  [[nodiscard]] const Texture& map() const { return map_; }

 private:
  Program program_;
  Texture map_;
  Framebuffer target_;
};

}  // namespace pelagos
