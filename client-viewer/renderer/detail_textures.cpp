#include "renderer/detail_textures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr int kTile = 256;
constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

/// Slopes of short waves: components with whole wave numbers along both sides, so that the tile is seamless.
/// Directions spread about x; every octave carries the same slope.
std::vector<float> make_ripples() {
  SplitMix64 random(7);
  std::vector<float> height_slopes(kTile * kTile * 3, 0.0F);
  constexpr int kWaves = 56;
  for (int w = 0; w < kWaves; ++w) {
    const double number = 3.0 * std::pow(14.0, w / (kWaves - 1.0));
    const double angle = (random.next_unit() + random.next_unit() + random.next_unit() - 1.5) * 1.7;
    const int kx = static_cast<int>(std::lround(number * std::cos(angle)));
    const int ky = static_cast<int>(std::lround(number * std::sin(angle)));
    const double length = std::hypot(kx, ky);
    if (length < 1.0) continue;
    const auto phase = static_cast<float>(random.next_unit()) * kTwoPi;
    const auto slope = static_cast<float>(0.026 * (0.6 + 0.8 * random.next_unit()));
    const float slope_x = slope * static_cast<float>(kx / length), slope_y = slope * static_cast<float>(ky / length);
    for (int y = 0; y < kTile; ++y)
      for (int x = 0; x < kTile; ++x) {
        const int turns = (kx * x + ky * y) & (kTile - 1);
        const float s = std::sin(kTwoPi * static_cast<float>(turns) / kTile + phase);
        float* texel = &height_slopes[static_cast<std::size_t>(3 * (y * kTile + x))];
        texel[0] += slope_x * s;
        texel[1] += slope_y * s;
      }
  }
  for (std::size_t i = 0; i < height_slopes.size(); i += 3)
    height_slopes[i + 2] = height_slopes[i] * height_slopes[i] + height_slopes[i + 1] * height_slopes[i + 1];
  return height_slopes;
}

/// Value noise on a lattice of `cells` that wraps round, at x, y in 0..1.
float tiling_noise(const std::vector<float>& lattice, int cells, float x, float y) {
  const float fx = x * static_cast<float>(cells), fy = y * static_cast<float>(cells);
  const int ix = static_cast<int>(std::floor(fx)), iy = static_cast<int>(std::floor(fy));
  const auto at = [&](int i, int j) {
    return lattice[static_cast<std::size_t>(((j % cells + cells) % cells) * 64 + (i % cells + cells) % cells)];
  };
  float u = fx - static_cast<float>(ix), v = fy - static_cast<float>(iy);
  u = u * u * (3 - 2 * u);
  v = v * v * (3 - 2 * v);
  return std::lerp(std::lerp(at(ix, iy), at(ix + 1, iy), u), std::lerp(at(ix, iy + 1), at(ix + 1, iy + 1), u), v);
}

/// Strands and holes: ridges of warped noise over three octaves, spread evenly over 0..1.
std::vector<float> make_foam() {
  SplitMix64 random(23);
  std::vector<float> lattice(64 * 64);
  for (float& value : lattice) value = static_cast<float>(random.next_unit());
  std::vector<float> pattern(kTile * kTile);
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      const float u = static_cast<float>(x) / kTile, v = static_cast<float>(y) / kTile;
      const float wu = u + 0.05F * (tiling_noise(lattice, 8, u, v) - 0.5F) + 0.02F * tiling_noise(lattice, 24, u, v);
      const float wv = v + 0.05F * (tiling_noise(lattice, 8, v, u) - 0.5F) + 0.02F * tiling_noise(lattice, 24, v, u);
      float sum = 0.0F, weight = 0.5F;
      for (int cells = 9; cells <= 60; cells = cells * 2) {
        sum += weight * (1.0F - std::abs(2.0F * tiling_noise(lattice, cells, wu, wv) - 1.0F));
        weight *= 0.55F;
      }
      pattern[static_cast<std::size_t>(y * kTile + x)] = sum + 0.25F * tiling_noise(lattice, 5, u, v);
    }
  std::vector<float> sorted = pattern;
  std::sort(sorted.begin(), sorted.end());
  for (float& value : pattern)
    value = static_cast<float>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin()) /
            static_cast<float>(sorted.size());
  return pattern;
}

}  // namespace

DetailTextures::DetailTextures()
    : sky_(2048, 256, GL_RGBA16F, GL_LINEAR, GL_REPEAT, 8),
      ripples_(kTile, kTile, GL_RGB16F, GL_LINEAR, GL_REPEAT, 0),
      foam_(kTile, kTile, GL_R8, GL_LINEAR, GL_REPEAT, 0) {
  glTextureParameteri(sky_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  const std::vector<float> slopes = make_ripples();
  glTextureSubImage2D(ripples_.id(), 0, 0, 0, kTile, kTile, GL_RGB, GL_FLOAT, slopes.data());
  glGenerateTextureMipmap(ripples_.id());
  const std::vector<float> pattern = make_foam();
  glTextureSubImage2D(foam_.id(), 0, 0, 0, kTile, kTile, GL_RED, GL_FLOAT, pattern.data());
  glGenerateTextureMipmap(foam_.id());

  const Program program("screen.vert", "sky.frag");
  const VertexArray nothing;
  const Framebuffer target({&sky_});
  target.bind();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  program.use();
  nothing.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glGenerateTextureMipmap(sky_.id());
  check_graphics("the detail textures");
}

}  // namespace pelagos
