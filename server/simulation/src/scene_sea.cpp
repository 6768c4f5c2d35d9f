#include "simulation/scene_sea.hpp"

#include <cmath>
#include <utility>

#include "scales/scales.hpp"
#include "simulation/open_sea.hpp"
#include "waves/sea_generator.hpp"
#include "waves/sea_state.hpp"

namespace pelagos {

MadeSea make_sea(const Scene& scene, SeaSettings settings) {
  settings.seed = settings.seed.value_or(scene.seed);
  SeaComponents made = make_sea_components(settings, {scale_gravity(scene.gravity), sea_depth(scene), scene.seed});
  return {std::move(made.waves), SeaRequest{std::move(settings), 4.0 * std::sqrt(made.left_out)}};
}

SceneSea make_scene_sea(const Scene& scene) {
  const FarSeaSettings& sea = scene.far_sea;
  const double gravity = scale_gravity(scene.gravity), depth = sea_depth(scene);
  if (sea.sea) {
    MadeSea made = make_sea(scene, *sea.sea);
    return {std::move(made.waves), depth, std::move(made.request)};
  }
  if (!sea.waves.empty()) return {wave_components(sea.waves, gravity, depth), depth, {}};
  return {make_wave_components({sea.beaufort, sea.wave_to_deg, sea.components, scene.seed, gravity}), depth, {}};
}

}  // namespace pelagos
