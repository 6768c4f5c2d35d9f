#include "renderer/composite.hpp"

#include <cstdint>

namespace pelagos {
namespace {

constexpr std::size_t kSpritesOfADrop = 8;  // kSprites of spray.vert

}  // namespace

CompositePass::CompositePass(int width, int height, bool smooth_edges)
    : join_program_("screen.vert", "join.frag"),
      spray_program_("spray.vert", "spray.frag"),
      edge_program_("screen.vert", "fxaa.frag"),
      picture_(width, height, GL_RGBA8, GL_LINEAR, GL_CLAMP_TO_EDGE),
      scene_inverse_(width, height, GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      smoothed_(width, height, GL_RGBA8, GL_NEAREST, GL_CLAMP_TO_EDGE),
      water_surface_(width, height, GL_RGBA32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      water_traits_(width, height, GL_RGBA16F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      join_target_({&picture_, &scene_inverse_, &water_surface_, &water_traits_}, true),
      water_target_({&picture_}, join_target_),
      spray_target_({&picture_}),
      smooth_target_({&smoothed_}),
      smooth_edges_(smooth_edges) {}

void CompositePass::compose(const OpaquePass& opaque, const FarSeaPass& far_sea, const ShortSea& short_sea,
                            const FluidPass& fluid, const DetailTextures& detail, const SlickMap* slick, bool wake) {
  glDisable(GL_BLEND);
  opaque.colour().bind(0);
  opaque.inverse_depth().bind(1);
  detail.sky().bind(5);
  nothing_.bind();

  join_target_.bind();
  far_sea.surface().bind(2);
  fluid.surface().bind(3);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_ALWAYS);
  join_program_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);

  water_target_.bind();
  water_surface_.bind(2);
  water_traits_.bind(3);
  opaque.mirrored().bind(4);
  detail.foam().bind(7);
  for (std::size_t t = 0; t < kShortWaveTiles; ++t) short_sea.tile(t).bind(static_cast<GLuint>(9 + t));
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);  // screen.vert draws at 0.5: over the 0 of water
  if (slick != nullptr) slick->film().bind(8);
  water_program(slick != nullptr, wake).use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_DEPTH_TEST);
}

const Program& CompositePass::water_program(bool slick, bool wake) {
  auto& program = water_programs_[(slick ? 1U : 0U) + (wake ? 2U : 0U)];
  if (!program)
    program = std::make_unique<Program>("screen.vert", "water.frag",
                                        std::string(slick ? "WITH_SLICK " : "") + (wake ? "WITH_WAKE" : ""));
  return *program;
}

void CompositePass::draw_spray(std::span<const DrawnParticle> drops, const DetailTextures& detail) {
  if (drops.empty()) return;
  drops_.upload(drops.data(), drops.size_bytes());
  const std::size_t sprites = drops.size() * kSpritesOfADrop;
  std::vector<std::uint32_t> indices;
  indices.reserve(sprites * 6);
  for (std::uint32_t i = 0; i < sprites; ++i)
    for (const std::uint32_t corner : {0U, 1U, 3U, 0U, 3U, 2U}) indices.push_back(4 * i + corner);
  quads_.upload(indices.data(), indices.size() * sizeof(std::uint32_t));
  glVertexArrayElementBuffer(array_.id(), quads_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, drops_.id());
  spray_target_.bind();
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  scene_inverse_.bind(0);
  detail.foam().bind(7);
  spray_program_.use();
  array_.bind();
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_BLEND);
}

void CompositePass::finish() {
  if (!smooth_edges_) return;
  smooth_target_.bind();
  picture_.bind(0);
  edge_program_.use();
  nothing_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace pelagos
