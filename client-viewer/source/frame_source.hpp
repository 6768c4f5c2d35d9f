#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "client/frame_receiver.hpp"

namespace pelagos {

/// Where frames come from: a server over DDS, or the viewer itself. All calls from one thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The oldest frame not yet taken; null if there is none.
  [[nodiscard]] virtual std::unique_ptr<OceanFrame> take_next() = 0;
  /// Gives a frame's memory back. Null is allowed.
  virtual void recycle(std::unique_ptr<OceanFrame> frame) = 0;
  [[nodiscard]] virtual std::optional<SceneInfo> scene_info() = 0;
  /// Changes when scene_info() does; 0 while there is none.
  [[nodiscard]] virtual std::uint64_t scene_revision() = 0;
  [[nodiscard]] virtual std::optional<ServerStatus> status() = 0;
  [[nodiscard]] virtual std::optional<WindSettings> wind() = 0;
  /// Of the last films of oil the one nearest to a simulated time, s; null where there is none.
  [[nodiscard]] virtual std::shared_ptr<const OceanSlick> slick_at(double time) = 0;

  /// ns: the steady clock here, that moments are told by.
  [[nodiscard]] virtual std::int64_t now_ns() = 0;
  /// Which simulated time is due at a moment; nothing before the first frame.
  [[nodiscard]] virtual std::optional<DueInstant> due_at(std::int64_t moment_ns) = 0;
  [[nodiscard]] virtual ClockState clock_state() = 0;
  /// Makes known how this viewer does.
  virtual void tell(const ViewerStatus& status) = 0;
  [[nodiscard]] virtual bool server_alive() = 0;
  [[nodiscard]] virtual ReceiverCounters counters() = 0;
};

/// Frames of a server, over DDS. @throws DdsError
[[nodiscard]] std::unique_ptr<FrameSource> make_dds_source(const DdsSettings& settings, const LocalClocks& clocks = {});

/// A made-up sea with a ship under way, 30 frames a second: for development and tests, without a server.
[[nodiscard]] std::unique_ptr<FrameSource> make_synthetic_source();

/// What the synthetic source makes, at one instant.
[[nodiscard]] SceneInfo synthetic_scene();
void fill_synthetic_frame(double time, OceanFrame& frame);

}  // namespace pelagos
