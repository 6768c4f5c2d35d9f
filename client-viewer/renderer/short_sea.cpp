#include "renderer/short_sea.hpp"

namespace pelagos {
namespace {

using Texel = ShortWaveTile::Texel;

/// Each texel becomes the mean of four: a level of half the side, in place.
void halve(std::vector<Texel>& level, int side) {
  const auto at = [&](int x, int y) -> Texel& { return level[static_cast<std::size_t>(y * side + x)]; };
  for (int y = 0; y < side / 2; ++y)
    for (int x = 0; x < side / 2; ++x) {
      const Texel &a = at(2 * x, 2 * y), &b = at(2 * x + 1, 2 * y), &c = at(2 * x, 2 * y + 1),
                  &d = at(2 * x + 1, 2 * y + 1);
      const auto mean = [&](float Texel::*part) { return 0.25F * (a.*part + b.*part + c.*part + d.*part); };
      // Earlier texels of the new level lie before those that are still to be read.
      level[static_cast<std::size_t>(y * (side / 2) + x)] = {mean(&Texel::slope_x), mean(&Texel::slope_y),
                                                             mean(&Texel::square), mean(&Texel::foam)};
    }
}

}  // namespace

ShortSea::ShortSea() {
  constexpr int kSide = ShortWaveTile::kSide;
  for (auto& texture : textures_)
    texture = std::make_unique<Texture>(kSide, kSide, GL_RGBA16F, GL_LINEAR, GL_REPEAT, 0);
}

void ShortSea::upload(const ShortWaves& waves) {
  for (std::size_t t = 0; t < kShortWaveTiles; ++t) {
    level_ = waves.tiles()[t].texels;
    GLint number = 0;
    for (int side = ShortWaveTile::kSide; side >= 1; side /= 2) {
      glTextureSubImage2D(textures_[t]->id(), number++, 0, 0, side, side, GL_RGBA, GL_FLOAT, level_.data());
      halve(level_, side);
    }
  }
}

}  // namespace pelagos
