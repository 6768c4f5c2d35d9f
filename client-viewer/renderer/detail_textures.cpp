#include "renderer/detail_textures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr int kTile = 256;

/// Value noise on a lattice of `across` times `up` cells that wraps round, at x, y in 0..1.
float tiling_noise(const std::vector<float>& lattice, int across, int up, float x, float y) {
  const float fx = x * static_cast<float>(across), fy = y * static_cast<float>(up);
  const int ix = static_cast<int>(std::floor(fx)), iy = static_cast<int>(std::floor(fy));
  const auto at = [&](int i, int j) {
    return lattice[static_cast<std::size_t>(((j % up + up) % up) * 64 + (i % across + across) % across)];
  };
  float u = fx - static_cast<float>(ix), v = fy - static_cast<float>(iy);
  u = u * u * (3 - 2 * u);
  v = v * v * (3 - 2 * v);
  return std::lerp(std::lerp(at(ix, iy), at(ix + 1, iy), u), std::lerp(at(ix, iy + 1), at(ix + 1, iy + 1), u), v);
}

/// Spreads values evenly over 0..1, in their order.
void spread_evenly(std::vector<float>& values) {
  std::vector<float> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (float& value : values)
    value = static_cast<float>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin()) /
            static_cast<float>(sorted.size());
}

std::vector<float> random_lattice(std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<float> lattice(64 * 64);
  for (float& value : lattice) value = static_cast<float>(random.next_unit());
  return lattice;
}

/// How close a place is to a border between cells about random points, 0..1 (Worley 1996); `across` times `up` cells.
float cell_borders(const std::vector<float>& lattice, int across, int up, float u, float v) {
  const float x = u * static_cast<float>(across), y = v * static_cast<float>(up);
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  float first = 9.0F, second = 9.0F;  // squares of the distances to the two nearest points
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int cx = (ix + dx + across) % across, cy = (iy + dy + up) % up;
      const float px = static_cast<float>(ix + dx) + lattice[static_cast<std::size_t>(cy * 64 + cx)];
      const float py = static_cast<float>(iy + dy) + lattice[static_cast<std::size_t>((63 - cx) * 64 + cy)];
      const float square = (px - x) * (px - x) + (py - y) * (py - y);
      second = std::min(second, std::max(first, square));
      first = std::min(first, square);
    }
  return std::max(1.0F - 1.4F * (std::sqrt(second) - std::sqrt(first)), 0.0F);
}

/// Threads along x: borders of long cells, bent a little, and thick in some places.
std::vector<float> make_threads() {
  const std::vector<float> lattice = random_lattice(29);
  std::vector<float> pattern(kTile * kTile);
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      const float u = static_cast<float>(x) / kTile, v = static_cast<float>(y) / kTile;
      const float bent =
          v + 0.04F * (tiling_noise(lattice, 3, 3, u, v) - 0.5F) + 0.015F * (tiling_noise(lattice, 9, 9, u, v) - 0.5F);
      float sum = 0.5F * tiling_noise(lattice, 3, 3, v, u), weight = 0.6F;
      for (int cells = 14; cells <= 56; cells *= 2) {
        sum += weight * cell_borders(lattice, cells / 7, cells, u, bent - std::floor(bent));
        weight *= 0.6F;
      }
      pattern[static_cast<std::size_t>(y * kTile + x)] = sum;
    }
  spread_evenly(pattern);
  return pattern;
}

/// Strands and holes: borders of warped cells over three octaves, spread evenly over 0..1.
std::vector<float> make_strands() {
  const std::vector<float> lattice = random_lattice(23);
  std::vector<float> pattern(kTile * kTile);
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      const float u = static_cast<float>(x) / kTile, v = static_cast<float>(y) / kTile;
      const float wu =
          u + 0.06F * (tiling_noise(lattice, 7, 7, u, v) - 0.5F) + 0.02F * tiling_noise(lattice, 25, 25, u, v);
      const float wv =
          v + 0.06F * (tiling_noise(lattice, 7, 7, v, u) - 0.5F) + 0.02F * tiling_noise(lattice, 25, 25, v, u);
      float sum = 0.45F * tiling_noise(lattice, 5, 5, wu, wv), weight = 0.5F;
      for (const int cells : {11, 23, 45}) {
        sum += weight * cell_borders(lattice, cells, cells, wu - std::floor(wu), wv - std::floor(wv));
        weight *= 0.6F;
      }
      pattern[static_cast<std::size_t>(y * kTile + x)] = sum;
    }
  spread_evenly(pattern);
  return pattern;
}

/// Both patterns, texel by texel.
std::vector<float> make_foam() {
  const std::vector<float> strands = make_strands(), threads = make_threads();
  std::vector<float> both;
  for (std::size_t i = 0; i < strands.size(); ++i) both.insert(both.end(), {strands[i], threads[i]});
  return both;
}

}  // namespace

DetailTextures::DetailTextures()
    : sky_program_("screen.vert", "sky.frag"),
      sky_(1024, 1024, GL_RGBA16F, GL_LINEAR, GL_CLAMP_TO_EDGE, 8),
      foam_(kTile, kTile, GL_RG8, GL_LINEAR, GL_REPEAT, 0),
      target_({&sky_}) {
  const std::vector<float> pattern = make_foam();
  glTextureSubImage2D(foam_.id(), 0, 0, 0, kTile, kTile, GL_RG, GL_FLOAT, pattern.data());
  glGenerateTextureMipmap(foam_.id());

  check_graphics("the detail textures");
}

void DetailTextures::draw_sky() {
  target_.bind();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  sky_program_.use();
  nothing_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glGenerateTextureMipmap(sky_.id());
}

}  // namespace pelagos
