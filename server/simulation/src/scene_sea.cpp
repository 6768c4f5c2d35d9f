#include "simulation/scene_sea.hpp"

#include "scales/scales.hpp"
#include "simulation/open_sea.hpp"
#include "waves/sea_state.hpp"

namespace pelagos {

WaveField scene_sea(const Scene& scene, double water_level) {
  const FarSeaSettings& sea = scene.far_sea;
  const double gravity = scale_gravity(scene.gravity), depth = sea_depth(scene);
  if (!sea.waves.empty()) return {wave_components(sea.waves, gravity, depth), water_level, depth};
  return {make_wave_components({sea.beaufort, sea.wave_to_deg, sea.components, scene.seed, gravity}), water_level,
          depth};
}

}  // namespace pelagos
