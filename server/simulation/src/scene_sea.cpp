#include "simulation/scene_sea.hpp"

#include <cmath>
#include <utility>

#include "scales/scales.hpp"
#include "simulation/growing_sea.hpp"
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
    std::optional<GrowingSea> growing;
    if (sea.sea->wind_sea) {
      const SteadyWind wind = steady_wind(scene.wind ? scene.wind->velocity : Eigen::Vector3d::Zero());
      growing = start_growing(*sea.sea, start_wind_sea(*sea.sea->wind_sea, wind, gravity), 0.0);
    }
    MadeSea made = make_sea(scene, growing ? present_sea(*growing, gravity) : *sea.sea);
    return {std::move(made.waves), depth, std::move(made.request), std::move(growing)};
  }
  if (!sea.waves.empty()) return {wave_components(sea.waves, gravity, depth), depth, {}, {}};
  return {make_wave_components({sea.beaufort, sea.wave_to_deg, sea.components, scene.seed, gravity}), depth, {}, {}};
}

}  // namespace pelagos
