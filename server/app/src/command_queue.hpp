#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "messages/given_names.hpp"
#include "values/command.hpp"

namespace pelagos {

struct QueuedCommand {
  Command command;
  std::string source;  ///< who asked for it
};

/// That the schedule was changed, for an event.
struct ScheduleChange {
  ScheduledCommand command;
  bool cancelled = false;  ///< else newly taken
  std::string by;          ///< who changed it
};

/// Commands on their way to a step boundary: those for the next one, and those that wait for a time. Any thread
/// submits, the simulation takes.
class CommandQueue {
 public:
  /// Commands that may wait for their time at once, the scene's events included.
  static constexpr std::size_t kMostScheduled = 1000;

  CommandQueue() = default;
  /// With the events of a scene, and the wind that it starts with. Sources are "scene event 1",
  /// "scene event 2", ... in the order given.
  CommandQueue(const std::vector<SceneEvent>& events, const std::optional<WindSettings>& wind);

  /// Takes a command for the next boundary, or says why it cannot be done now.
  std::optional<std::string> submit(const Command& command, const std::string& source);

  /// What schedule did: `id` > 0 if the command waits now; else the time has passed (`past`) or there is a refusal.
  struct Scheduled {
    std::uint64_t id = 0;
    bool past = false;
    double present_time = 0.0;  ///< s, of the last boundary
    std::string refusal;
  };
  /// Takes a command for the first boundary at or after `at` (s, simulated, finite).
  Scheduled schedule(const Command& command, double at, const std::string& source);
  /// False if none waits under that id.
  bool cancel(std::uint64_t id, const std::string& by);
  /// All that wait, in the order in which they fall due.
  [[nodiscard]] std::vector<ScheduledCommand> scheduled() const;
  [[nodiscard]] std::size_t scheduled_count() const;

  /// The wind that will have been set last when a command for `at` (nothing: the next boundary) is applied; nothing: no
  /// wind.
  [[nodiscard]] std::optional<WindSettings> wind_before(std::optional<double> at) const;

  /// What will bear a name then.
  [[nodiscard]] GivenNames names_before(std::optional<double> at) const;
  /// What does now: the world knows which commands it refused and which sources have run out.
  void set_names(const GivenNames& given);

  /// Moves what is to be applied at a boundary at time `now` into `out`: what has fallen due, in order of time and then
  /// as given, and after it what was submitted, in order of arrival. `now` never decreases but after a restored fault.
  void take(double now, std::vector<QueuedCommand>& out);
  /// Moves the changes of the schedule since the last call into `out`.
  void take_changes(std::vector<ScheduleChange>& out);

 private:
  static constexpr std::size_t kCapacity = 1000;
  void insert(ScheduledCommand command);

  mutable std::mutex mutex_;
  std::vector<QueuedCommand> commands_;
  std::vector<ScheduledCommand> scheduled_;  ///< by time, then by id
  std::vector<ScheduleChange> changes_;
  std::optional<WindSettings> wind_;  ///< last set by what was taken
  GivenNames given_;                  ///< as last told, and by what was taken since
  std::uint64_t last_id_ = 0;
  double now_ = 0.0;
  bool will_pause_ = false;  ///< once all that waits for the next boundary is done
};

}  // namespace pelagos
