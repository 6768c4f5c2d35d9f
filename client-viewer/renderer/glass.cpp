#include "renderer/glass.hpp"

namespace pelagos {

GlassPass::GlassPass() : program_("glass.vert", "glass.frag") {}

void GlassPass::draw(const Eigen::Vector3f& low, const Eigen::Vector3f& high, const Framebuffer& picture,
                     const Texture& scene_inverse) {
  picture.bind();
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  scene_inverse.bind(0);
  program_.use();
  program_.set_vector3("low", low.data());
  program_.set_vector3("high", high.data());
  nothing_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 24);
  glDisable(GL_BLEND);
}

}  // namespace pelagos
