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

/// A sea that the wind raises; see simulation/growing_sea.hpp.
struct GrowingSea {
  SeaSettings asked;                      ///< with its wind_sea, and the systems beside it
  WindSea now, shown;                     ///< what the wind has raised, and what the waves around were made from
  double looked_at = 0.0, renewal = 0.0;  ///< s, simulated time: of `now`; when other waves may be made next

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("asked", self.asked);
    visit("now", self.now);
    visit("shown", self.shown);
    visit("looked_at", self.looked_at);
    visit("renewal", self.renewal);
  }
};

/// The waves around the patch at the start of a scene. Those of systems take a while to make: once for a run.
struct SceneSea {
  std::vector<WaveComponent> waves;
  double depth = kInfiniteDepth;      ///< m
  std::optional<SeaRequest> request;  ///< what they were made from; nothing where that was not by systems
  std::optional<GrowingSea> growing;  ///< where the wind raises it

  /// @param water_level  m, world, of the water at rest
  [[nodiscard]] WaveField at_level(double water_level) const { return {waves, water_level, depth}; }
};
[[nodiscard]] SceneSea make_scene_sea(const Scene& scene);

}  // namespace pelagos
