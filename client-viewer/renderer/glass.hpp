#pragma once

#include <Eigen/Core>

#include "renderer/gl_objects.hpp"

namespace pelagos {

/// The four panes of a tank of glass, over a finished picture.
class GlassPass {
 public:
  GlassPass();
  /// The view block must be bound.
  /// @param low, high      m, relative to the eye: corners of the tank
  /// @param scene_inverse  what the picture shows
  void draw(const Eigen::Vector3f& low, const Eigen::Vector3f& high, const Framebuffer& picture,
            const Texture& scene_inverse);

 private:
  Program program_;
  VertexArray nothing_;
};

}  // namespace pelagos
