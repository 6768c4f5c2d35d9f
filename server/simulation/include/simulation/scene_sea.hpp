#pragma once

#include <optional>
#include <vector>

#include "values/scene.hpp"
#include "values/sea_request.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

/// A sea that was asked for, and the waves that it becomes.
struct MadeSea {
  std::vector<WaveComponent> waves;
  SeaRequest request;
};
/// In the scene's gravity and depth, with its seed where the sea has none.
[[nodiscard]] MadeSea make_sea(const Scene& scene, SeaSettings settings);
/// What the scene's sea was made from; nothing where that was not by systems.
[[nodiscard]] std::optional<SeaRequest> scene_sea_request(const Scene& scene);

/// The waves around the patch at the start of a scene. @param water_level  m, world, of the water at rest
[[nodiscard]] WaveField scene_sea(const Scene& scene, double water_level);

}  // namespace pelagos
