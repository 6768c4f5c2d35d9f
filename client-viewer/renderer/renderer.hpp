#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "channels/camera.hpp"
#include "meshes/mesh_loader.hpp"
#include "packing/surface_particle.hpp"
#include "renderer/picture.hpp"
#include "renderer/sky.hpp"
#include "renderer/slick_map.hpp"
#include "values/body.hpp"
#include "values/scene_info.hpp"

namespace pelagos {

enum class Quality { kLow, kMedium, kHigh };

struct RenderSettings {
  int width = 1280, height = 720;  ///< pixels, of one channel
  int guard = 96;                  ///< pixels
  Quality quality = Quality::kMedium;
  bool measure_passes = true;  ///< waits for the graphics card between passes, so that the times are true
  Weather weather = {};
};

/// What to draw at one instant. Spans must outlive the call.
struct SeaMoment {
  double time = 0.0;                                 ///< s, simulation time shown
  double ahead = 0.0;                                ///< s, from the frame to the time shown: particles go on so long
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, world, of the particles
  std::span<const SurfaceParticle> particles;
  std::span<const std::uint8_t> loose;  ///< of each particle, see find_loose_water; empty: the renderer finds out
  std::span<const BodyState> bodies;    ///< at the time shown
  Slick slick;                          ///< the film of oil, if there is one
  std::optional<Eigen::Vector2d> wind;  ///< m/s, towards; unknown: from the far sea
};

/// Names of the passes, in order, as reports use them.
inline constexpr std::array<const char*, 7> kPassNames = {"slick",     "opaque",    "far_sea",    "particles",
                                                          "smoothing", "composite", "spray_edges"};
using PassTimes = std::array<double, kPassNames.size()>;  ///< ms

/// Draws one channel into a picture. Needs a current OpenGL 4.5 core context, at construction and afterwards.
class Renderer {
 public:
  explicit Renderer(const RenderSettings& settings);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Takes over far sea and patch.
  void set_scene(const SceneInfo& scene);
  /// The bodies' meshes from now on; bodies without one are not drawn. What is on the graphics card already stays
  /// there.
  void set_meshes(const BodyMeshes& meshes);

  /// Takes over the foam that another one has laid down, which goes on without.
  void keep_foam_of(Renderer& other);

  void draw(const Camera& camera, const SeaMoment& moment);

  [[nodiscard]] const PassTimes& pass_times() const;  ///< of the last draw
  [[nodiscard]] Picture read_picture() const;
  /// Linear depth in metres of what the last picture shows, row by row from the bottom; 0: sky.
  [[nodiscard]] std::vector<float> read_depth() const;
  /// Linear depth of the ellipsoids before smoothing, of the guarded fluid buffer; fluid_size_of() gives its size.
  [[nodiscard]] std::vector<float> draw_particle_depth(const Camera& camera, const SeaMoment& moment);
  [[nodiscard]] unsigned picture_framebuffer() const;  ///< to copy to a window

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Part of the picture's resolution at which the fluid passes work.
[[nodiscard]] double fluid_scale(Quality quality);

}  // namespace pelagos
