#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/show_clock.hpp"
#include "packing/surface_particle.hpp"
#include "pelagos_dds/configuration.hpp"
#include "values/body.hpp"
#include "values/command.hpp"
#include "values/scene_info.hpp"
#include "values/slick.hpp"
#include "values/status.hpp"
#include "values/wind.hpp"

namespace pelagos {

/// A frame as a viewer draws it: the water and the bodies of one instant. World frame ENU, body axes x forward, y port,
/// z up.
struct OceanFrame {
  std::uint64_t source = 0;                          ///< which run of which server
  std::uint64_t frame = 0;                           ///< 0, 1, ...; gaps are frames that never came
  double simulation_time = 0.0;                      ///< s
  std::int64_t wall_time_ns = 0;                     ///< system clock of the server, when the frame was completed
  std::chrono::steady_clock::time_point received{};  ///< here
  std::int64_t received_ns = 0;                      ///< by LocalClocks::steady_ns
  std::optional<std::int64_t> completed_ns;          ///< by the steady clock of the server, where it is known
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, world; particles and box are relative to it
  Box box;                                           ///< m, tight around the particles, relative to `origin`
  double largest_speed = 0.0;                        ///< m/s, of the particles
  std::uint32_t total_particles = 0;  ///< in the simulation; the difference to particles.size() was left out
  std::vector<SurfaceParticle> particles;
  std::vector<BodyState> bodies;
};

/// The film of oil on the water at one instant.
struct OceanSlick {
  std::uint64_t frame = 0;                           ///< as in OceanFrame
  double simulation_time = 0.0;                      ///< s
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, world; the discs are relative to it
  std::vector<SlickDisc> discs;
};

/// What happened to frames since the start.
struct ReceiverCounters {
  std::uint64_t received = 0;        ///< valid frames
  std::uint64_t missed = 0;          ///< gaps in the frame numbers
  std::uint64_t jumps = 0;           ///< numbers that went back, or on by more than 100,000: not counted as missed
  std::uint64_t repeated = 0;        ///< the last frame again, as while the sea is paused
  std::uint64_t replaced = 0;        ///< received, but newer ones came before it was taken
  std::uint64_t refused = 0;         ///< wrong payload size, numbers not finite or out of range
  std::uint64_t foreign = 0;         ///< from a second server while the first one lives
  std::uint64_t intruding = 0;       ///< samples with the followed server's source that another process sends
  std::uint64_t slicks = 0;          ///< valid slicks
  std::uint64_t slicks_refused = 0;  ///< too many elements, numbers not finite or out of range
  std::uint64_t others_refused = 0;  ///< scene, status, wind and events, likewise
};

/// Listens to one server. A thread of its own takes the samples, checks and decodes them; all calls here are quick and
/// may come from any thread. Which server is followed, and when another one, says SourceWatch.
class FrameReceiver {
 public:
  /// Joins the domain. Throws DdsError.
  explicit FrameReceiver(const DdsSettings& settings, const LocalClocks& clocks = {});
  ~FrameReceiver();
  FrameReceiver(const FrameReceiver&) = delete;
  FrameReceiver& operator=(const FrameReceiver&) = delete;

  /// The newest frame not yet taken; null if there is none. Older ones are gone. The caller owns it; keep as many as
  /// needed and give them back for reuse.
  [[nodiscard]] std::unique_ptr<OceanFrame> take_newest();
  /// The oldest frame not yet taken; null if there is none. At most 16 wait, of 4,000,000 particles together.
  [[nodiscard]] std::unique_ptr<OceanFrame> take_next();
  /// Gives a frame's memory back. Null is allowed.
  void recycle(std::unique_ptr<OceanFrame> frame);
  /// Waits until take_newest() has something. False after `timeout`.
  [[nodiscard]] bool wait_for_frame(std::chrono::milliseconds timeout) const;

  /// Of the server that is followed; empty until it has come (a late viewer gets it within a second or so). Its sea
  /// is the newest that has come; surfaces of its bodies come one by one, mostly before it.
  [[nodiscard]] std::optional<SceneInfo> scene_info() const;
  /// Goes up by one with each scene_info, each sea and each surface of a body that comes: when to look again.
  [[nodiscard]] std::uint64_t scene_revision() const;
  [[nodiscard]] std::optional<ServerStatus> status() const;
  /// The wind that blows; empty if none does or nothing is known yet.
  [[nodiscard]] std::optional<WindSettings> wind() const;
  /// The newest slick of the server that is followed; null where none has come, as in scenes without oil.
  [[nodiscard]] std::shared_ptr<const OceanSlick> slick() const;
  /// Of the last 16 the one nearest to a simulated time, s.
  [[nodiscard]] std::shared_ptr<const OceanSlick> slick_at(double time) const;

  /// The moment `steady_ns` of the clock here: which simulated time is due. Nothing before the first frame.
  [[nodiscard]] std::optional<DueInstant> due_at(std::int64_t steady_ns) const;
  [[nodiscard]] ClockState clock_state() const;
  /// Writes it to `viewer_status_v1`; `viewer`, `source`, and what is of the clock are filled in here.
  void tell(ViewerStatus status);
  /// Events since the last call, oldest first; at most 256 are kept. Their texts are printable (text/printable.hpp).
  [[nodiscard]] std::vector<Event> take_events();

  /// The server that is followed was heard within the last 2 s: any sample of it counts, and it sends one each second
  /// at least.
  [[nodiscard]] bool server_alive() const;
  [[nodiscard]] ReceiverCounters counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
