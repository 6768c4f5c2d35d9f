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

/// The waves around the patch at the start of a scene. Those of systems take a while to make: once for a run.
struct SceneSea {
  std::vector<WaveComponent> waves;
  double depth = kInfiniteDepth;      ///< m
  std::optional<SeaRequest> request;  ///< what they were made from; nothing where that was not by systems

  /// @param water_level  m, world, of the water at rest
  [[nodiscard]] WaveField at_level(double water_level) const { return {waves, water_level, depth}; }
};
[[nodiscard]] SceneSea make_scene_sea(const Scene& scene);

}  // namespace pelagos
