#include "renderer/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pelagos {

FluidSize fluid_size_of(const Camera& camera, double scale) {
  FluidSize size;
  size.width = std::max(static_cast<int>(std::lround((camera.width + 2 * camera.guard) * scale)), 1);
  size.height = std::max(static_cast<int>(std::lround((camera.height + 2 * camera.guard) * scale)), 1);
  size.tan_half_x = camera.tan_half_x * size.width / (scale * camera.width);
  size.tan_half_y = camera.tan_half_y * size.height / (scale * camera.height);
  size.focal_pixels = scale * camera.focal_pixels();
  return size;
}

FluidPass::FluidPass(int width, int height)
    : depth_program_("particle.vert", "particle_depth.frag"),
      attribute_program_("particle.vert", "particle_attributes.frag"),
      smooth_program_("screen.vert", "smooth.frag"),
      slope_program_("screen.vert", "slopes.frag"),
      first_(width, height, GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      second_(width, height, GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      attributes_(std::max(width / 2, 1), std::max(height / 2, 1), GL_RG16F, GL_LINEAR, GL_CLAMP_TO_EDGE),
      surface_(width, height, GL_RGBA32F, GL_LINEAR, GL_CLAMP_TO_EDGE),
      first_target_({&first_}),
      second_target_({&second_}),
      attribute_target_({&attributes_}),
      surface_target_({&surface_}) {}

void FluidPass::bind_quads(std::size_t count) {
  if (count > quad_capacity_) {
    quad_capacity_ = count + count / 2;
    std::vector<std::uint32_t> indices;
    indices.reserve(quad_capacity_ * 6);
    for (std::uint32_t i = 0; i < quad_capacity_; ++i)
      for (const std::uint32_t corner : {0U, 1U, 3U, 0U, 3U, 2U}) indices.push_back(4 * i + corner);
    quads_.upload(indices.data(), indices.size() * sizeof(std::uint32_t), GL_STATIC_DRAW);
    glVertexArrayElementBuffer(array_.id(), quads_.id());
  }
  array_.bind();
}

void FluidPass::bind_particles() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, particles_.id());
  array_.bind();
}

void FluidPass::draw_particles(std::span<const DrawnParticle> particles) {
  const float nothing[4] = {0, 0, 0, 0};
  const auto count = static_cast<GLsizei>(particles.size() * 6);
  particles_.upload(particles.data(), particles.size_bytes());
  bind_quads(particles.size());
  bind_particles();
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);

  first_target_.bind();
  glClearNamedFramebufferfv(first_target_.id(), GL_COLOR, 0, nothing);
  glBlendEquation(GL_MAX);
  depth_program_.use();
  depth_program_.set("inflate", 1.0F);
  if (count > 0) glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);

  attribute_target_.bind();
  glClearNamedFramebufferfv(attribute_target_.id(), GL_COLOR, 0, nothing);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
  attribute_program_.use();
  attribute_program_.set("inflate", 1.5F);
  first_.bind(0);
  if (count > 0) glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_BLEND);
}

void FluidPass::smooth() {
  nothing_.bind();
  smooth_program_.use();
  smooth_program_.set("widest", 48.0F);
  second_target_.bind();
  first_.bind(0);
  smooth_program_.set("axis", 0.0F, 1.0F);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  first_target_.bind();
  second_.bind(0);
  smooth_program_.set("axis", 1.0F, 0.0F);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  surface_target_.bind();
  slope_program_.use();
  first_.bind(0);
  attributes_.bind(1);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace pelagos
