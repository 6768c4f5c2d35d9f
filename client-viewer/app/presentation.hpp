#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "channels/rig.hpp"
#include "renderer/renderer.hpp"
#include "source/frame_source.hpp"

namespace pelagos {

/// Keeps the newest frame and draws it at the time of display: water and bodies go on from the frame at constant
/// velocity, for at most 0.2 s. Without a server the last frame stays.
class Presentation {
 public:
  Presentation(FrameSource& source, Channel channel, const RenderSettings& settings, std::filesystem::path mesh_folder);

  /// Takes what has arrived. True if there is a frame that was not drawn yet.
  bool update();
  /// A scene and a frame have come, so that draw() has something to show.
  [[nodiscard]] bool ready() const { return frame_ != nullptr && scene_revision_ != 0; }
  /// The meshes of the scene's bodies have been read and taken, or cannot be read.
  [[nodiscard]] bool has_meshes() const {
    return meshes_wanted_ && loader_.done() && mesh_revision_ == loader_.revision();
  }
  /// Draws with the renderer. Needs ready().
  void draw();
  /// Another size of picture; the next draw uses it.
  void resize(int width, int height);

  [[nodiscard]] Renderer& renderer() { return *renderer_; }
  [[nodiscard]] const OceanFrame* frame() const { return frame_.get(); }
  [[nodiscard]] const SceneInfo& scene() const { return scene_; }
  [[nodiscard]] const Channel& channel() const { return channel_; }
  [[nodiscard]] bool server_alive() const { return source_.server_alive(); }

 private:
  void take_scene();
  void take_meshes();
  [[nodiscard]] double time_since_frame() const;
  [[nodiscard]] Camera camera_or_stand_in(std::span<const BodyState> bodies);

  FrameSource& source_;
  Channel channel_;
  RenderSettings settings_;
  MeshLoader loader_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<OceanFrame> frame_;
  std::vector<std::uint8_t> loose_;  ///< of the frame's particles
  SceneInfo scene_;
  std::uint64_t scene_revision_ = 0;
  std::chrono::steady_clock::time_point scene_came_{};
  bool meshes_wanted_ = false;
  std::uint64_t mesh_revision_ = 0;  ///< of what the renderer has
  bool warned_about_mount_ = false;
};

/// ns since 1970 on this machine's system clock.
[[nodiscard]] std::int64_t system_time_ns();

}  // namespace pelagos
