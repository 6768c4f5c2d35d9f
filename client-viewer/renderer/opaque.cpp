#include "renderer/opaque.hpp"

#include <algorithm>

namespace pelagos {

void draw_meshes(const std::vector<PlacedMesh>& meshes, const Program& program) {
  for (const PlacedMesh& placed : meshes) {
    program.set_matrix3("world_from_body", placed.world_from_body.data());
    program.set_vector3("body_position", placed.position.data());
    placed.mesh->draw();
  }
}

OpaquePass::OpaquePass(int width, int height, int mirror_divisor, int samples)
    : mirror_levels_(mirror_divisor > 2 ? 1 : 5),  // a small image is blurred already
      program_("opaque.vert", "opaque.frag"),
      colour_(width, height, GL_RGBA16F, GL_LINEAR, GL_CLAMP_TO_EDGE),
      inverse_depth_(width, height, GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      mirrored_(std::max(width / mirror_divisor, 1), std::max(height / mirror_divisor, 1), GL_RGBA16F, GL_LINEAR,
                GL_CLAMP_TO_EDGE, mirror_levels_),
      mirrored_depth_(mirrored_.width(), mirrored_.height(), GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      samples_(samples > 1 ? std::make_unique<MultisampleTarget>(
                                 width, height, std::initializer_list<GLenum>{GL_RGBA16F, GL_R32F}, samples)
                           : nullptr),
      target_({&colour_, &inverse_depth_}, true),
      mirror_target_({&mirrored_, &mirrored_depth_}, true) {}

void OpaquePass::draw(const std::vector<PlacedMesh>& meshes) {
  samples_ ? samples_->begin_solids() : target_.begin_solids();
  draw_meshes_once(meshes, false);
  if (samples_) samples_->resolve_into(target_);
  mirror_target_.begin_solids();
  draw_meshes_once(meshes, true);
  if (mirror_levels_ > 1) glGenerateTextureMipmap(mirrored_.id());
}

void OpaquePass::draw_meshes_once(const std::vector<PlacedMesh>& meshes, bool mirror) {
  program_.use();
  program_.set("mirror", mirror ? 1.0F : 0.0F);
  draw_meshes(meshes, program_);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace pelagos
