#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "renderer/gl_objects.hpp"
#include "renderer/mesh.hpp"

namespace pelagos {

/// A mesh and where it is, relative to the eye.
struct PlacedMesh {
  const Mesh* mesh = nullptr;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Matrix3f world_from_body = Eigen::Matrix3f::Identity();
};

/// Draws each with a program in use that knows `world_from_body` and `body_position`.
void draw_meshes(const std::vector<PlacedMesh>& meshes, const Program& program);

/// Draws rigid bodies: once as they are (colour, inverse depth) and once mirrored in the mean water level.
class OpaquePass {
 public:
  /// @param mirror_divisor  the mirror image has so many times fewer pixels a side
  /// @param samples  of a pixel
  OpaquePass(int width, int height, int mirror_divisor, int samples);
  void draw(const std::vector<PlacedMesh>& meshes);

  /// Times the share of the pixel that bodies cover; alpha: that share.
  [[nodiscard]] const Texture& colour() const { return colour_; }
  [[nodiscard]] const Texture& inverse_depth() const { return inverse_depth_; }  ///< times that share
  [[nodiscard]] const Texture& mirrored() const {
    return mirrored_;
  }  ///< alpha: covered; with mip levels unless it is small

 private:
  void draw_meshes_once(const std::vector<PlacedMesh>& meshes, bool mirror);

  int mirror_levels_;
  Program program_;
  Texture colour_, inverse_depth_, mirrored_, mirrored_depth_;
  std::unique_ptr<MultisampleTarget> samples_;  ///< null: one sample
  Framebuffer target_, mirror_target_;
};

}  // namespace pelagos
