#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "values/scene.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

/// The surface of a body as the server uses it, in body axes, for viewers that do not have its file. Published on
/// `body_shape_v1`.
struct BodySurface {
  static constexpr std::uint32_t kMostTriangles = 100'000;  ///< of a mesh that is sent

  std::uint64_t file_digest = 0;                   ///< of the mesh file's bytes (shapes/file_digest.hpp); 0: unknown
  Eigen::Vector3d low = Eigen::Vector3d::Zero();   ///< m, corners of the box around the mesh
  Eigen::Vector3d high = Eigen::Vector3d::Zero();  ///< m
  std::uint32_t triangle_count = 0;                ///< of the mesh, also where it is too large to be sent
  std::vector<Eigen::Vector3f> vertices;           ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< anticlockwise seen from outside; empty if not sent
};

/// A body's shape as viewers draw it.
struct BodyInfo {
  std::uint32_t id = 0;
  std::string name;
  std::string mesh_file;  ///< file name, without folders
  double mesh_scale = 1.0;
  std::shared_ptr<const BodySurface> surface = nullptr;  ///< null: a primitive, or not known
};

/// Everything that a viewer which comes late needs once, published on `scene_info_v1`.
struct SceneInfo {
  std::string scene;
  std::string build;  ///< version of the server
  std::uint64_t seed = 0;
  double frame_interval = 1.0 / 30;  ///< s
  double particle_spacing = 0.0;     ///< m
  double water_level = 0.0;          ///< m, world: the mean level of the water at rest
  Box patch;                         ///< m, world
  bool tank_walls_visible = false;
  GeodeticOrigin origin;
  WaveField sea;  ///< around the patch; on the wire `sea_v1` has it with the blends that run
  std::vector<BodyInfo> bodies;
};

}  // namespace pelagos
