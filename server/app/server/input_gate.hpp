#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "command_queue.hpp"
#include "control/control_server.hpp"
#include "pelagos_dds/participant.hpp"
#include "replay.hpp"
#include "simulation/world.hpp"
#include "transport/pose_receiver.hpp"
#include "transport/probe_receiver.hpp"
#include "values/command_surroundings.hpp"
#include "values/given_names.hpp"
#include "values/scene.hpp"
#include "values/step_inputs.hpp"

namespace pelagos {

/// The only way into the world: commands of stations, of the scene's events and of the governor, requests for probes
/// and poses of bridges; each with who gave it. Or, in a replay, what the log of another run holds.
class InputGate {
 public:
  /// @param replay  instead of the scene's events, the governor, and what comes from outside
  InputGate(const Scene& scene, std::optional<Replay> replay);

  /// Opens the topics that bridges write. Throws DdsError.
  void open(const std::shared_ptr<DdsParticipant>& participant, const DdsLog& log);

  // From any thread: what stations ask. Before the first boundary a command without a time is answered at once: refused
  // where it does not fit the scene or speaks of what will not be there, else scheduled for that boundary, which may
  // still refuse it for what only the world tells.
  std::optional<Refusal> submit(const Command& command, const std::string& source, TakeAnswer answer = {});
  ScheduleAnswer schedule(const Command& command, double at, const std::string& source);
  bool cancel(std::uint64_t id, const std::string& source) { return commands_.cancel(id, source); }
  [[nodiscard]] std::vector<ScheduledCommand> scheduled() const { return commands_.scheduled(); }
  [[nodiscard]] std::size_t scheduled_count() const { return commands_.scheduled_count(); }

  /// Before the first boundary, where the run goes on from a state: lets go of the scene's events up to its time, s.
  void drop_events_until(double time) { commands_.drop_events_until(time); }

  /// What a request asked that cannot be asked.
  struct Refused {
    GivenCommand given;
    Refusal why;
  };
  /// What is due at a boundary.
  struct Batch {
    StepInputs inputs;
    std::vector<TakeAnswer> answers;  ///< of each command; may be empty
    std::vector<Refused> refused;
    std::vector<ScheduleChange> schedule;
  };
  /// Fills `batch` with what is due after `step` steps, at `time` (s, simulated).
  void collect(std::uint64_t step, double time, Batch& batch);

  /// Nothing comes in any more; stations that wait are told why.
  void close();

  [[nodiscard]] const std::optional<Replay>& replay() const { return replay_; }
  /// Holds the state against the log of the run that is replayed, where it says what it was. @return what differs
  [[nodiscard]] std::string check_replay(const World& world);
  [[nodiscard]] PoseCounters pose_counters() const { return poses_ ? poses_->counters() : PoseCounters{}; }
  [[nodiscard]] std::uint64_t dropped_requests() const { return probes_ ? probes_->dropped() : 0; }

 private:
  [[nodiscard]] std::optional<Refusal> refuse_in_replay(const Command& command) const;
  [[nodiscard]] std::optional<Refusal> refuse_before_start(const Command& command) const;
  std::optional<Refusal> submit_before_start(const Command& command, const std::string& source, TakeAnswer answer);
  void take_requests(Batch& batch);
  void take_poses(Batch& batch);

  std::vector<std::uint32_t> driven_;
  GeodeticOrigin origin_;
  CommandSurroundings around_;
  std::set<std::uint32_t> scene_probes_;  ///< ids
  std::atomic<bool> started_ = false;     ///< inputs have been collected
  PoseLimits limits_;
  CommandQueue commands_;
  std::optional<Replay> replay_;
  std::unique_ptr<PoseReceiver> poses_;
  std::unique_ptr<ProbeReceiver> probes_;
  std::vector<QueuedCommand> taken_commands_;
  std::vector<ReceivedPose> taken_poses_;
  std::vector<ProbeRequest> taken_requests_;
};

}  // namespace pelagos
