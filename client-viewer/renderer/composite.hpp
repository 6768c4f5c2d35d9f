#pragma once

#include <array>
#include <memory>

#include "renderer/detail_textures.hpp"
#include "renderer/far_sea.hpp"
#include "renderer/fluid.hpp"
#include "renderer/gl_objects.hpp"
#include "renderer/opaque.hpp"
#include "renderer/short_sea.hpp"
#include "renderer/slick_map.hpp"

namespace pelagos {

/// Passes 7 and 8: ship, open sea, patch and sky into one picture; spray; edge smoothing.
class CompositePass {
 public:
  CompositePass(int width, int height, bool smooth_edges);

  /// @param slick  may be null: there has been no oil yet
  /// @param wake   whether hulls move or foam lies on the foam map
  void compose(const OpaquePass& opaque, const FarSeaPass& far_sea, const ShortSea& short_sea, const FluidPass& fluid,
               const DetailTextures& detail, const SlickMap* slick, bool wake);
  void draw_spray(std::span<const DrawnParticle> drops, const DetailTextures& detail);
  void finish();
  [[nodiscard]] const Framebuffer& unfinished() const { return spray_target_; }  ///< the picture before finish()

  [[nodiscard]] const Texture& picture() const { return smooth_edges_ ? smoothed_ : picture_; }
  [[nodiscard]] GLuint picture_framebuffer() const { return (smooth_edges_ ? smooth_target_ : spray_target_).id(); }
  /// Inverse linear depth of what the picture shows; 0 for sky.
  [[nodiscard]] const Texture& inverse_depth() const { return scene_inverse_; }

 private:
  /// The variant of water.frag, made when it is first asked for.
  const Program& water_program(bool slick, bool wake);

  std::array<std::unique_ptr<Program>, 4> water_programs_;
  Program join_program_, spray_program_, edge_program_;
  Texture picture_, scene_inverse_, smoothed_, water_surface_, water_traits_;
  Framebuffer join_target_, water_target_, spray_target_, smooth_target_;
  Buffer drops_, quads_;
  VertexArray nothing_, array_;
  bool smooth_edges_;
};

}  // namespace pelagos
