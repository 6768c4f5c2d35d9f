#include "command_queue.hpp"

#include <algorithm>
#include <utility>

namespace pelagos {

CommandQueue::CommandQueue(const std::vector<SceneEvent>& events) {
  for (const SceneEvent& event : events) {
    const std::uint64_t id = ++last_id_;
    insert({id, event.at, event.command, "scene event " + std::to_string(id)});
  }
  last_event_ = last_id_;
}

void CommandQueue::drop_events_until(double time) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(scheduled_,
                [&](const ScheduledCommand& waiting) { return waiting.id <= last_event_ && waiting.at <= time; });
}

void CommandQueue::insert(ScheduledCommand command) {
  const auto place = std::upper_bound(scheduled_.begin(), scheduled_.end(), command.at,
                                      [](double at, const ScheduledCommand& other) { return at < other.at; });
  scheduled_.insert(place, std::move(command));
}

std::optional<Refusal> CommandQueue::submit(const Command& command, const std::string& source, TakeAnswer answer) {
  const std::scoped_lock lock(mutex_);
  if (!closed_.empty()) return Refusal{"", closed_};
  if (commands_.size() >= kCapacity)
    return Refusal{"", "too many commands are waiting; allowed: " + std::to_string(kCapacity) + "; send fewer"};
  commands_.push_back({{command, source}, std::move(answer)});
  return std::nullopt;
}

CommandQueue::Scheduled CommandQueue::schedule(const Command& command, double at, const std::string& source) {
  const std::scoped_lock lock(mutex_);
  Scheduled answer;
  answer.present_time = now_;
  answer.past = at < now_;
  if (answer.past) return answer;
  if (scheduled_.size() >= kMostScheduled || changes_.size() >= kCapacity) {
    answer.refusal = Refusal{"", "too many commands wait for their time; allowed: " + std::to_string(kMostScheduled) +
                                     "; cancel some, or wait for them"};
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

void CommandQueue::take(double now, std::vector<QueuedCommand>& out) {
  out.clear();
  const std::scoped_lock lock(mutex_);
  now_ = now;
  const auto due = std::find_if(scheduled_.begin(), scheduled_.end(),
                                [now](const ScheduledCommand& waiting) { return waiting.at > now; });
  for (auto it = scheduled_.begin(); it != due; ++it)
    out.push_back({{std::move(it->command), std::move(it->source)}, {}});
  scheduled_.erase(scheduled_.begin(), due);
  std::move(commands_.begin(), commands_.end(), std::back_inserter(out));
  commands_.clear();
}

void CommandQueue::close(const std::string& why) {
  std::vector<QueuedCommand> left;
  {
    const std::scoped_lock lock(mutex_);
    closed_ = why;
    left.swap(commands_);
  }
  for (const QueuedCommand& queued : left)
    if (queued.answer) queued.answer({0, Refusal{"", why}});
}

void CommandQueue::take_changes(std::vector<ScheduleChange>& out) {
  out.clear();
  const std::scoped_lock lock(mutex_);
  out.swap(changes_);
}

}  // namespace pelagos
