#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "announcer.hpp"
#include "control/control_server.hpp"
#include "input_gate.hpp"
#include "pelagos_dds/participant.hpp"
#include "recorder.hpp"
#include "scene/command_log.hpp"
#include "simulation/world.hpp"
#include "simulation_loop.hpp"
#include "status_board.hpp"
#include "surface_desk.hpp"
#include "transport/clock_link.hpp"
#include "transport/frame_publisher.hpp"
#include "transport/surface_link.hpp"
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
  std::string command_log;           ///< file that every input is written to; empty: none
  std::string start_state;           ///< bytes of a state file that the run goes on from; empty: the scene's start
  std::string save_state;            ///< file that the state is saved to at the end; empty: none
  std::optional<CommandLog> replay;  ///< instead of the scene's events, what comes from outside, and the governor
};

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
  bool replay_differs = false;       ///< from the logged run
  std::size_t hull_samples = 0;
  int threads = 1;
  std::uint64_t state_hash = 0;  ///< of the water at the end, see physics/fluid.hpp
  std::uint64_t world_hash = 0;  ///< of the whole state at the end
  bool log_failed = false;       ///< the command log could not be written to its end
  bool state_failed = false;     ///< the state at the end could not be saved
};

/// The server: wires a world to its links and runs it. Network threads only touch queues, mailboxes and the status
/// board.
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
  [[nodiscard]] ControlHooks control_hooks();
  /// As the board has it, with what is counted elsewhere.
  [[nodiscard]] ServerStatus status() const;
  void open_links();
  void open_world(SceneSea sea);
  void tell_placed(const World& world);
  void go_on_from_state();
  void open_records();
  /// Says how the replay ended. @return whether all that was compared had the same bits
  [[nodiscard]] bool tell_replay_end() const;
  [[nodiscard]] bool save_end_state() const;

  // server_doors.cpp
  [[nodiscard]] std::vector<OpenLink> find_open_links(const DdsParticipant& participant, const DdsSettings& dds) const;

  ServerOptions options_;
  const std::atomic<bool>& stop_;
  InputGate gate_;
  SurfaceDesk desk_;
  StatusBoard board_;
  ServerStatus status_;     ///< as the run starts
  std::optional<Air> air_;  ///< likewise
  std::unique_ptr<ControlServer> control_;
  std::shared_ptr<DdsParticipant> participant_;
  std::unique_ptr<FramePublisher> publisher_;
  std::unique_ptr<ClockLink> clock_link_;
  std::unique_ptr<SurfaceLink> surface_link_;
  std::unique_ptr<World> world_;
  std::unique_ptr<Announcer> announcer_;
  std::optional<Recorder> recorder_;
};

}  // namespace pelagos
