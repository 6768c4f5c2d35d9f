#pragma once

#include <memory>

#include "renderer/foam_map.hpp"
#include "renderer/gl_objects.hpp"

namespace pelagos {

/// The foam map on the graphics card: a texture for each level, from the first foam on.
class FoamLayer {
 public:
  /// Copies what has changed.
  void upload(FoamMap& map);
  /// To the units from `first` on; nothing before the first foam.
  void bind(GLuint first) const;

 private:
  std::array<std::unique_ptr<Texture>, kFoamLevels> textures_;
};

}  // namespace pelagos
