#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "values/command.hpp"
#include "values/command_answer.hpp"
#include "values/step_inputs.hpp"

namespace pelagos {

/// A command that is due, and who waits for what becomes of it; nobody: an empty function.
struct QueuedCommand {
  GivenCommand given;
  TakeAnswer answer;
};

/// That the schedule was changed, for an event.
struct ScheduleChange {
  ScheduledCommand command;
  bool cancelled = false;  ///< else newly taken
  std::string by;          ///< who changed it
};

/// Commands on their way to a step boundary: those for the next one, and those that wait for a time. Any thread
/// submits, the simulation takes. Whether a command can be done is found out where it is due.
class CommandQueue {
 public:
  /// Commands that may wait for their time at once, the scene's events included.
  static constexpr std::size_t kMostScheduled = 1000;

  CommandQueue() = default;
  /// With the events of a scene. Sources are "scene event 1", "scene event 2", ... in the order given.
  explicit CommandQueue(const std::vector<SceneEvent>& events);

  /// Takes a command for the next boundary. @return why it cannot be taken; then `answer` is not kept
  std::optional<Refusal> submit(const Command& command, const std::string& source, TakeAnswer answer = {});

  /// What schedule did: `id` > 0 if the command waits now; else the time has passed (`past`), or there is a refusal.
  struct Scheduled {
    std::uint64_t id = 0;
    bool past = false;
    double present_time = 0.0;  ///< s, of the last boundary
    std::optional<Refusal> refusal;
  };
  /// Takes a command for the first boundary at or after `at` (s, simulated, finite).
  Scheduled schedule(const Command& command, double at, const std::string& source);
  /// Lets go of the scene's events up to a time, s, that included: their effect is in the state that was loaded.
  void drop_events_until(double time);
  /// False if none waits under that id.
  bool cancel(std::uint64_t id, const std::string& by);
  /// All that wait, in the order in which they fall due.
  [[nodiscard]] std::vector<ScheduledCommand> scheduled() const;
  [[nodiscard]] std::size_t scheduled_count() const;

  /// Moves what is to be applied at a boundary at time `now` into `out`: what has fallen due, in order of time and then
  /// as given, and after it what was submitted, in order of arrival. `now` never decreases but after a restored fault.
  void take(double now, std::vector<QueuedCommand>& out);
  /// Moves the changes of the schedule since the last call into `out`.
  void take_changes(std::vector<ScheduleChange>& out);

  /// Nothing is taken any more, and whoever waits for an answer is told `why`.
  void close(const std::string& why);

 private:
  static constexpr std::size_t kCapacity = 1000;
  void insert(ScheduledCommand command);

  mutable std::mutex mutex_;
  std::vector<QueuedCommand> commands_;
  std::vector<ScheduledCommand> scheduled_;  ///< by time, then by id
  std::vector<ScheduleChange> changes_;
  std::uint64_t last_id_ = 0, last_event_ = 0;  ///< the scene's events have the first ids
  double now_ = 0.0;
  std::string closed_;  ///< why; empty: it is open
};

}  // namespace pelagos
