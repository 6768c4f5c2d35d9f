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
#include "source/frame_window.hpp"
#include "source/skew.hpp"

namespace pelagos {

/// Draws the instant that is due: the schedule's time a delay ago. Particles come from the nearer of the two frames
/// around it, moved by their velocities over half an interval at most; bodies lie between both; wave field and sky are
/// computed for it; the film of oil is the nearest in time. Without frames for it the picture holds.
class Presentation {
 public:
  /// @param delay  s, behind the schedule
  Presentation(FrameSource& source, Channel channel, const RenderSettings& settings, std::filesystem::path mesh_folder,
               double delay);

  /// Takes what has arrived.
  void update();
  /// A scene and a frame have come, so that draw() has something to show.
  [[nodiscard]] bool ready() const { return !frames_.empty() && scene_revision_ != 0; }
  /// The meshes of the scene's bodies have been read and taken, or cannot be read.
  [[nodiscard]] bool has_meshes() const {
    return meshes_wanted_ && loader_.done() && mesh_revision_ == loader_.revision();
  }
  /// Draws with the renderer what is due at that moment of the source's clock. Needs ready().
  void draw(std::int64_t shown_at_ns);
  /// The picture is on the screen since then. Counts the skew, and tells it once a second.
  void shown(std::int64_t shown_at_ns);
  /// Another size of picture; the next draw uses it.
  void resize(int width, int height);

  [[nodiscard]] Renderer& renderer() { return *renderer_; }
  /// Whose particles were drawn, or will be first; null before the first.
  [[nodiscard]] const OceanFrame* frame() const { return drawn_.nearer; }
  /// That frame was drawn for the first time.
  [[nodiscard]] bool fresh() const { return fresh_; }
  /// s, simulated: the instant drawn last.
  [[nodiscard]] double time() const { return drawn_.time; }
  [[nodiscard]] const SceneInfo& scene() const { return scene_; }
  [[nodiscard]] const Channel& channel() const { return channel_; }
  [[nodiscard]] bool server_alive() const { return source_.server_alive(); }

  [[nodiscard]] const Skew& skew() const { return skew_; }
  [[nodiscard]] double last_skew() const { return last_skew_; }  ///< s, signed
  [[nodiscard]] double delay() const { return 1e-9 * static_cast<double>(delay_ns_); }
  [[nodiscard]] std::uint64_t pictures_held() const { return held_; }
  [[nodiscard]] std::uint64_t frames_never_drawn() const { return frames_.never_drawn(); }

 private:
  void take_scene();
  void take_meshes();
  void find_loose(const OceanFrame& frame);
  [[nodiscard]] Camera camera_or_stand_in(std::span<const BodyState> bodies);

  FrameSource& source_;
  Channel channel_;
  RenderSettings settings_;
  std::int64_t delay_ns_;
  MeshLoader loader_;
  std::unique_ptr<Renderer> renderer_;
  FrameWindow frames_;
  FramePair drawn_;  ///< its pointers hold until frames_ changes
  std::uint64_t drawn_frame_ = 0, drawn_source_ = 0;
  bool fresh_ = false;
  std::vector<std::uint8_t> loose_;  ///< of the frame's particles
  Skew skew_;
  double last_skew_ = 0.0;
  std::uint64_t pictures_ = 0, held_ = 0;
  std::int64_t told_ns_ = 0;
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
