#include "command_queue.hpp"

#include <algorithm>
#include <utility>

namespace pelagos {

namespace {

void follow_wind(const Command& command, std::optional<WindSettings>& wind) {
  if (const auto* set = std::get_if<SetWind>(&command)) wind = set->wind;
  if (std::holds_alternative<ClearWind>(command)) wind.reset();
}

void follow_pause(const Command& command, bool& paused) {
  if (std::holds_alternative<PauseSimulation>(command)) paused = true;
  if (std::holds_alternative<ResumeSimulation>(command)) paused = false;
}

}  // namespace

CommandQueue::CommandQueue(const std::vector<SceneEvent>& events, const std::optional<WindSettings>& wind)
    : wind_(wind) {
  for (const SceneEvent& event : events) {
    const std::uint64_t id = ++last_id_;
    insert({id, event.at, event.command, "scene event " + std::to_string(id)});
  }
}

void CommandQueue::insert(ScheduledCommand command) {
  const auto place = std::upper_bound(scheduled_.begin(), scheduled_.end(), command.at,
                                      [](double at, const ScheduledCommand& other) { return at < other.at; });
  scheduled_.insert(place, std::move(command));
}

std::optional<std::string> CommandQueue::submit(const Command& command, const std::string& source) {
  const std::scoped_lock lock(mutex_);
  if (commands_.size() >= kCapacity) return "too many commands are waiting; send fewer";
  if (std::holds_alternative<StepSimulation>(command) && !will_pause_)
    return "the simulation is running; pause it before stepping";
  follow_pause(command, will_pause_);
  commands_.push_back({command, source});
  return std::nullopt;
}

CommandQueue::Scheduled CommandQueue::schedule(const Command& command, double at, const std::string& source) {
  const std::scoped_lock lock(mutex_);
  Scheduled answer;
  answer.present_time = now_;
  answer.past = at < now_;
  if (answer.past) return answer;
  if (scheduled_.size() >= kMostScheduled || changes_.size() >= kCapacity) {
    answer.refusal = "too many commands wait for their time; allowed: " + std::to_string(kMostScheduled) +
                     "; cancel some, or wait for them";
    return answer;
  }
  answer.id = ++last_id_;
  const ScheduledCommand waiting{answer.id, at, command, source};
  insert(waiting);
  changes_.push_back({waiting, false, source});
  return answer;
}

bool CommandQueue::cancel(std::uint64_t id, const std::string& by) {
  const std::scoped_lock lock(mutex_);
  const auto found =
      std::find_if(scheduled_.begin(), scheduled_.end(), [id](const ScheduledCommand& c) { return c.id == id; });
  if (found == scheduled_.end()) return false;
  changes_.push_back({*found, true, by});
  scheduled_.erase(found);
  return true;
}

std::vector<ScheduledCommand> CommandQueue::scheduled() const {
  const std::scoped_lock lock(mutex_);
  return scheduled_;
}

std::size_t CommandQueue::scheduled_count() const {
  const std::scoped_lock lock(mutex_);
  return scheduled_.size();
}

std::optional<WindSettings> CommandQueue::wind_before(std::optional<double> at) const {
  const std::scoped_lock lock(mutex_);
  std::optional<WindSettings> wind = wind_;
  for (const QueuedCommand& queued : commands_) follow_wind(queued.command, wind);
  for (const ScheduledCommand& waiting : scheduled_)
    if (at && waiting.at <= *at) follow_wind(waiting.command, wind);
  return wind;
}

GivenNames CommandQueue::names_before(std::optional<double> at) const {
  const std::scoped_lock lock(mutex_);
  GivenNames given = given_;
  for (const QueuedCommand& queued : commands_) given.follow(queued.command);
  for (const ScheduledCommand& waiting : scheduled_)
    if (at && waiting.at <= *at) given.follow(waiting.command);
  return given;
}

void CommandQueue::set_names(const GivenNames& given) {
  const std::scoped_lock lock(mutex_);
  given_ = given;
}

void CommandQueue::take(double now, std::vector<QueuedCommand>& out) {
  out.clear();
  const std::scoped_lock lock(mutex_);
  now_ = now;
  const auto due = std::find_if(scheduled_.begin(), scheduled_.end(),
                                [now](const ScheduledCommand& waiting) { return waiting.at > now; });
  for (auto it = scheduled_.begin(); it != due; ++it) {
    follow_pause(it->command, will_pause_);
    out.push_back({std::move(it->command), std::move(it->source)});
  }
  scheduled_.erase(scheduled_.begin(), due);
  for (QueuedCommand& queued : commands_) {
    follow_pause(queued.command, will_pause_);
    out.push_back(std::move(queued));
  }
  commands_.clear();
  for (const QueuedCommand& queued : out) {
    follow_wind(queued.command, wind_);
    given_.follow(queued.command);
  }
}

void CommandQueue::take_changes(std::vector<ScheduleChange>& out) {
  out.clear();
  const std::scoped_lock lock(mutex_);
  out.swap(changes_);
}

}  // namespace pelagos
