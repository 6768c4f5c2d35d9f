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

OpaquePass::OpaquePass(int width, int height, int mirror_divisor)
    : mirror_levels_(mirror_divisor > 2 ? 1 : 5),  // a small image is blurred already
      program_("opaque.vert", "opaque.frag"),
      colour_(width, height, GL_RGBA16F, GL_LINEAR, GL_CLAMP_TO_EDGE),
      inverse_depth_(width, height, GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      mirrored_(std::max(width / mirror_divisor, 1), std::max(height / mirror_divisor, 1), GL_RGBA16F, GL_LINEAR,
                GL_CLAMP_TO_EDGE, mirror_levels_),
      mirrored_depth_(mirrored_.width(), mirrored_.height(), GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      target_({&colour_, &inverse_depth_}, true),
      mirror_target_({&mirrored_, &mirrored_depth_}, true) {}

void OpaquePass::draw(const std::vector<PlacedMesh>& meshes) {
  draw_into(target_, meshes, false);
  draw_into(mirror_target_, meshes, true);
  if (mirror_levels_ > 1) glGenerateTextureMipmap(mirrored_.id());
}

void OpaquePass::draw_into(const Framebuffer& target, const std::vector<PlacedMesh>& meshes, bool mirror) {
  target.begin_solids();
  program_.use();
  program_.set("mirror", mirror ? 1.0F : 0.0F);
  draw_meshes(meshes, program_);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace pelagos
