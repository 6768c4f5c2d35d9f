#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "pelagos_dds/participant.hpp"
#include "schedule/schedule.hpp"
#include "values/command.hpp"
#include "values/scene_info.hpp"
#include "values/snapshot.hpp"
#include "values/status.hpp"

namespace pelagos {

struct PublisherSettings {
  std::uint64_t source = 0;      ///< names this run of the server on the wire; 0: draw one at random
  bool bodies_in_ned = false;    ///< body states go out in NED, body axes forward, starboard, down; else in ENU
  double status_interval = 1.0;  ///< s, wall time; status and wind go out with the first frame after it
};

/// Since the start, unless stated. Times are wall time.
struct PublisherCounters {
  std::uint64_t submitted = 0;
  std::uint64_t published = 0;          ///< frames written
  std::uint64_t dropped = 0;            ///< frames replaced in the mailbox before they were taken
  std::uint64_t failed = 0;             ///< writes that the DDS library refused, and frames lost to lack of memory
  std::uint64_t refused_particles = 0;  ///< not finite or absurd, left out of their frame
  std::uint64_t events_dropped = 0;     ///< more than 256 waited
  double bytes_per_particle = 0.0;      ///< of the last frame with particles: records and header and bodies
  double handover_us_mean = 0.0;        ///< submit(), as the caller sees it
  double handover_us_peak = 0.0;
  double pack_ms_mean = 0.0;   ///< of a frame: quantize and pack
  double frame_ms_mean = 0.0;  ///< of a frame: pack and write
  double frame_ms_peak = 0.0;
};

/// Publishes what the simulation hands over: frames, status, wind and events, each as idl/pelagos.idl says. Packs and
/// writes on a thread of its own. Readers that are late, slow, stopped or dead never hold it up: nothing waits for an
/// acknowledgement. While no frame comes, the last status and the last frame (with its slick) go out again twice a
/// second: a viewer that joins a paused sea has it at once, and every viewer sees that the server lives.
class FramePublisher {
 public:
  /// Publishes `info` at once, for viewers that come at any time; without it they see by the status that a server
  /// starts. Throws DdsError.
  FramePublisher(std::shared_ptr<DdsParticipant> participant, const std::optional<SceneInfo>& info,
                 const PublisherSettings& settings = {}, DdsLog log = {});
  /// Publishes what still waits, then stops.
  ~FramePublisher();
  FramePublisher(const FramePublisher&) = delete;
  FramePublisher& operator=(const FramePublisher&) = delete;

  /// An empty snapshot to fill; memory of earlier ones where there is some.
  [[nodiscard]] std::unique_ptr<Snapshot> acquire();

  /// Hands a frame over, in microseconds; never waits for the network. If the one before has not been taken yet, it is
  /// dropped and counted. From one thread. `frames_published` and `frames_dropped` of its status are filled in here.
  /// Null is ignored.
  void submit(std::unique_ptr<Snapshot> snapshot);

  /// Status alone, at once: while paused there are no frames.
  void submit_status(const ServerStatus& status);

  /// Queued; goes out before the next frame.
  void publish_event(const Event& event);

  /// Replaces what late viewers get.
  void publish_scene_info(const SceneInfo& info);

  /// Queued; goes out before the next frame. Only the newest counts. For viewers that come at any time.
  void publish_sea(const WaveField& sea);

  /// A piece that no frame made, as of a pause. Queued; only the newest counts. For viewers that come at any time.
  void publish_schedule(const SchedulePiece& piece);

  [[nodiscard]] std::uint64_t source() const;
  [[nodiscard]] PublisherCounters counters() const;
  /// Viewers connected, as far as is known: one that died counts for up to 10 s more.
  [[nodiscard]] std::uint32_t viewers() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
