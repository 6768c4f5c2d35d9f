#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "command_queue.hpp"
#include "control/control_server.hpp"
#include "convergence_watch.hpp"
#include "governor.hpp"
#include "hold_watch.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/participant.hpp"
#include "replay.hpp"
#include "scene/command_log.hpp"
#include "simulation/world.hpp"
#include "spill_watch.hpp"
#include "status_window.hpp"
#include "transport/frame_publisher.hpp"
#include "transport/pose_receiver.hpp"
#include "transport/probe_receiver.hpp"
#include "values/scene.hpp"

namespace pelagos {

struct ServerOptions {
  Scene scene;
  std::uint32_t domain = 0;
  ControlOptions control;
  int threads = 1;
  double duration = 0.0;  ///< s: wall clock when paced, simulated when not; 0: until stopped
  bool paced = true;
  std::string dds_config;
  bool bodies_in_ned = false;        ///< body states and loads go out in NED; else in ENU
  std::string command_log;           ///< file that every applied command is written to; empty: none
  std::optional<CommandLog> replay;  ///< instead of the scene's events, the stations' commands and the governor
};

/// How a run ended.
enum class ServerEnd { kStopped, kDurationReached, kReplayEnded, kNumericalFault };

/// Everything that a report of a run states; see run_report.hpp.
struct ServerSummary {
  ServerEnd end = ServerEnd::kStopped;
  ServerStatus status;
  RunningMeans run;
  double lowest_real_time_factor = 0.0;
  double surface_ms_mean = 0.0;  ///< of a frame: detection and anisotropy
  PublisherCounters publisher;
  PoseCounters poses;
  ControlStatistics control;
  std::uint64_t effort_changes = 0;  ///< that the governor made
  double frame_budget = 0.0;         ///< s; 0 without a governor
  std::size_t hull_samples = 0;
  int threads = 1;
  std::uint64_t state_hash = 0;  ///< of the water at the end, see physics/fluid.hpp
  bool log_failed = false;       ///< the command log could not be written to its end
};

/// The server: one world, its publisher, its pose receiver and its control link, wired together. The calling thread
/// advances the world; network threads only touch queues and mailboxes.
class Server {
 public:
  /// Opens the control link, joins DDS and builds the world. Throws DdsError, ControlError or std::invalid_argument,
  /// each with what to do: also if a replay is not of this scene. @param stop  set from a signal handler: ends
  /// construction and run early
  Server(const ServerOptions& options, const std::atomic<bool>& stop);
  ~Server();

  /// Runs until stopped, out of time or broken.
  ServerSummary run();

  [[nodiscard]] std::uint16_t control_port() const { return control_->port(); }

 private:
  void open_links();
  void open_world();
  [[nodiscard]] ControlHooks control_hooks();
  [[nodiscard]] ServerSummary summarize();

  // server_commands.cpp
  void open_command_log();
  void close_command_log();
  void watch_command_log();
  std::optional<std::string> refuse_in_replay(const Command& command) const;
  ScheduleAnswer schedule(const Command& command, double at, const std::string& source);
  void announce_schedule();
  void take_probe_requests();
  void apply_commands();
  void tell_names();
  void apply(const QueuedCommand& queued);
  bool apply_to_clock(const Command& command);
  void notice_closed_axes();

  // server_doors.cpp
  void tell_open_links(const DdsParticipant& participant, const DdsSettings& dds);
  void fill_pose_counts(ServerStatus& status) const;
  void watch_refusals();
  void watch_dropped_requests();
  void log_event(const Event& event);

  void take_poses();
  void advance();
  void publish_frame(StepReport& report);
  void report_fault(const WorldStep& step);
  void govern(double frame_seconds);
  void wait_paused();
  void publish_first_frame();
  void refresh_status();
  void log_status(const ServerStatus& status);
  void watch_poses(const std::vector<BodyState>& states);
  void watch_places(const std::vector<BodyState>& states);
  void watch_oil(const OilBudget& oil);
  void announce(const std::string& kind, const std::string& source, const std::string& text);
  [[nodiscard]] bool out_of_time() const;
  [[nodiscard]] bool replay_ended() const { return replay_ && replay_->ended(world_->step()); }
  [[nodiscard]] ServerStatus current_status() const;
  [[nodiscard]] AirReading read_air(const std::vector<Eigen::Vector3d>& position) const;

  ServerOptions options_;
  const std::atomic<bool>& stop_;
  CommandQueue commands_;
  std::optional<Replay> replay_;
  std::optional<CommandLogWriter> command_log_;
  std::unique_ptr<ControlServer> control_;
  std::unique_ptr<World> world_;
  std::unique_ptr<FramePublisher> publisher_;
  std::unique_ptr<PoseReceiver> poses_;
  std::unique_ptr<ProbeReceiver> probe_requests_;
  StatusWindow window_;
  ConvergenceWatch convergence_;
  std::optional<Governor> governor_;
  SpillWatch spill_watch_;

  mutable std::mutex status_mutex_;
  ServerStatus status_;     ///< shared with the control link
  std::optional<Air> air_;  ///< likewise: at status_.simulation_time

  std::vector<QueuedCommand> taken_commands_;
  std::vector<ScheduleChange> schedule_changes_;
  std::vector<ReceivedPose> taken_poses_;
  std::vector<ProbeRequest> taken_requests_;
  std::vector<PoseHealth> pose_health_;
  std::map<std::string, RateLimitedLog> event_logs_;  ///< by kind: a flood of one does not hide another
  std::uint64_t refusals_told_ = 0;                   ///< poses refused or corrected at the last event about them
  std::uint64_t requests_dropped_ = 0;                ///< for probes, told so far
  std::int64_t next_refusals_ns_ = 0, next_dropped_ns_ = 0;
  HoldWatch hold_watch_;
  std::vector<bool> outside_;  ///< by body: last seen outside the tank
  StepReport last_report_;
  std::uint64_t events_ = 0, recoveries_ = 0, effort_changes_ = 0;
  double frame_busy_s_ = 0.0;        ///< spent on the frame that is being computed
  std::uint32_t steps_to_make_ = 0;  ///< while paused
  bool paused_ = false;
  bool broken_ = false;
  bool closed_axes_noticed_ = false;  ///< that a current cannot flow through the tank
  double surface_s_ = 0.0;
  std::uint64_t frames_filled_ = 0;
  bool log_fault_told_ = false;  ///< that the command log cannot be written
  std::int64_t start_ns_ = 0, next_log_ns_ = 0, next_flush_ns_ = 0;
};

}  // namespace pelagos
