#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "values/command.hpp"

namespace pelagos {

struct QueuedCommand {
  Command command;
  std::string source;  ///< who asked for it
};

/// Commands on their way from the control link to the next step boundary. Any thread submits, the simulation takes.
class CommandQueue {
 public:
  /// Takes a command, or says why it cannot be done now.
  std::optional<std::string> submit(const Command& command, const std::string& source) {
    const std::scoped_lock lock(mutex_);
    if (commands_.size() >= kCapacity) return "too many commands are waiting; send fewer";
    if (std::holds_alternative<PauseSimulation>(command)) will_pause_ = true;
    if (std::holds_alternative<ResumeSimulation>(command)) will_pause_ = false;
    if (std::holds_alternative<StepSimulation>(command) && !will_pause_)
      return "the simulation is running; pause it before stepping";
    commands_.push_back({command, source});
    return std::nullopt;
  }

  /// Moves all waiting commands into `out`, in order of arrival.
  void take(std::vector<QueuedCommand>& out) {
    out.clear();
    const std::scoped_lock lock(mutex_);
    out.swap(commands_);
  }

 private:
  static constexpr std::size_t kCapacity = 1000;
  std::mutex mutex_;
  std::vector<QueuedCommand> commands_;
  bool will_pause_ = false;  ///< once all that waits is done
};

}  // namespace pelagos
