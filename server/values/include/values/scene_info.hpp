#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "values/scene.hpp"
#include "waves/wave_components.hpp"

namespace pelagos {

/// A body's shape as viewers draw it.
struct BodyInfo {
  std::uint32_t id = 0;
  std::string name;
  std::string mesh_file;  ///< file name, without folders
  double mesh_scale = 1.0;
};

/// Everything that a viewer which comes late needs once, published on `scene_info_v1`.
struct SceneInfo {
  std::string scene;
  std::string build;  ///< version of the server
  std::uint64_t seed = 0;
  double frame_interval = 1.0 / 30;  ///< s
  double particle_spacing = 0.0;     ///< m
  double water_level = 0.0;          ///< m, world: the mean level of the water at rest
  Box tank;                          ///< m, world
  bool tank_walls_visible = false;
  GeodeticOrigin origin;
  std::vector<WaveComponent> far_sea;
  std::vector<BodyInfo> bodies;
};

}  // namespace pelagos
