#include "renderer/foam_layer.hpp"

#include <algorithm>

namespace pelagos {
namespace {

constexpr int kSide = FoamLevel::kSide;

/// A run of lattice indices as texels of one row of the texture.
struct Run {
  int first = 0, count = 0;
};

/// The run wraps round at most once.
std::array<Run, 2> wrapped(std::int64_t low, std::int64_t high) {
  const int start = static_cast<int>(low & (kSide - 1)),
            count = static_cast<int>(std::min<std::int64_t>(high - low, kSide));
  const int before = std::min(count, kSide - start);
  return {{{start, before}, {0, count - before}}};
}

}  // namespace

void FoamLayer::upload(FoamMap& map) {
  if (!map.present()) return;
  glPixelStorei(GL_UNPACK_ROW_LENGTH, kSide);
  for (std::size_t i = 0; i < kFoamLevels; ++i) {
    if (!textures_[i]) textures_[i] = std::make_unique<Texture>(kSide, kSide, GL_RG32F, GL_LINEAR, GL_REPEAT);
    const FoamLevel::Area area = map.take_changed(i);
    if (area.empty()) continue;
    const FoamLevel& level = map.levels()[i];
    for (const Run& rows : wrapped(area.low[1], area.high[1]))
      for (const Run& columns : wrapped(area.low[0], area.high[0])) {
        if (rows.count == 0 || columns.count == 0) continue;
        const auto corner = static_cast<std::size_t>(rows.first * kSide + columns.first);
        glTextureSubImage2D(textures_[i]->id(), 0, columns.first, rows.first, columns.count, rows.count, GL_RG,
                            GL_FLOAT, &level.texels[corner]);
      }
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void FoamLayer::bind(GLuint first) const {
  for (std::size_t i = 0; i < kFoamLevels; ++i)
    if (textures_[i]) textures_[i]->bind(first + static_cast<GLuint>(i));
}

}  // namespace pelagos
