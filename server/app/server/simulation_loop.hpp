#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "announcer.hpp"
#include "convergence_watch.hpp"
#include "governor.hpp"
#include "input_gate.hpp"
#include "recorder.hpp"
#include "run_clock.hpp"
#include "schedule/schedule_fit.hpp"
#include "simulation/world.hpp"
#include "status_board.hpp"
#include "status_window.hpp"
#include "surface_desk.hpp"
#include "transport/frame_publisher.hpp"
#include "watches.hpp"

namespace pelagos {

struct LoopOptions {
  double duration = 0.0;  ///< s: wall clock when paced, simulated when not; 0: until stopped
  bool paced = true;
  bool saves_state = false;  ///< at the end, with what is due there
};

/// How a run ended.
enum class ServerEnd { kStopped, kDurationReached, kReplayEnded, kNumericalFault };

/// What a loop drives. All outlive it.
struct LoopParts {
  World& world;
  InputGate& gate;
  SurfaceDesk& desk;
  Recorder& recorder;
  StatusBoard& board;
  Announcer& announcer;
  FramePublisher& publisher;
};

/// Advances a world: takes what is due at each step boundary, answers it and logs it, makes a step, publishes each
/// frame, and puts up the status. One thread.
class SimulationLoop {
 public:
  /// @param status  what is told of the run from its start on
  SimulationLoop(const LoopParts& parts, const LoopOptions& options, ServerStatus status);

  /// Runs until stopped, out of time, at the end of a replay or broken.
  ServerEnd run(const std::atomic<bool>& stop);

  [[nodiscard]] RunningMeans whole_run() const;
  [[nodiscard]] double lowest_real_time_factor() const { return window_.lowest_real_time_factor(); }
  [[nodiscard]] double mean_surface_ms() const;
  [[nodiscard]] std::uint64_t effort_changes() const { return effort_changes_; }
  [[nodiscard]] double frame_budget() const { return governor_ ? governor_->budget() : 0.0; }

 private:
  /// Nothing: it goes on.
  [[nodiscard]] std::optional<ServerEnd> ended(const std::atomic<bool>& stop) const;
  void take_inputs();
  void answer(std::size_t index, const CommandOutcome& outcome, bool changed);
  void tell_refusal(const std::string& source, const std::string& text);
  void stand_still();
  void make_step();
  void publish_frame(StepReport& report);
  void publish_first_frame();
  void submit_frame(std::unique_ptr<Snapshot> snapshot);
  void tell_schedule(const std::optional<SchedulePiece>& piece);
  void check_replay();
  void report_fault(const WorldStep& step);
  void govern(double frame_seconds);
  void refresh_status();
  void put_up_status();
  void fill_pose_counts();
  void log_status();

  LoopParts parts_;
  LoopOptions options_;
  RunClock clock_;
  ScheduleFit schedule_;
  InputGate::Batch batch_;
  Watches watches_;
  StatusWindow window_;
  ConvergenceWatch convergence_;
  std::optional<Governor> governor_;
  ServerStatus status_;
  StepReport last_report_;
  bool broken_ = false;
  std::uint64_t announced_ = 0;  ///< events, when the status was last put up
  std::uint64_t effort_changes_ = 0, frames_filled_ = 0;
  double frame_busy_s_ = 0.0;  ///< spent on the frame that is being computed
  double surface_s_ = 0.0;
  std::int64_t start_ns_ = 0, next_log_ns_ = 0, next_status_ns_ = 0;
};

}  // namespace pelagos
