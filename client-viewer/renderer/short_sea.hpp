#pragma once

#include <memory>

#include "renderer/gl_objects.hpp"
#include "renderer/short_waves.hpp"

namespace pelagos {

/// Tiles of short waves on the graphics card, with all their mip levels.
class ShortSea {
 public:
  ShortSea();

  void upload(const ShortWaves& waves);
  [[nodiscard]] const Texture& tile(std::size_t which) const {
    return *textures_[which];
  }  ///< see ShortWaveTile::Texel

 private:
  std::array<std::unique_ptr<Texture>, kShortWaveTiles> textures_;
  std::vector<ShortWaveTile::Texel> level_;
};

}  // namespace pelagos
