#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "announcer.hpp"
#include "scene/command_log.hpp"
#include "simulation/world.hpp"

namespace pelagos {

/// Keeps the log of a run: every input with the step before which it took effect and who gave it, and the state's hash
/// each simulated second.
class Recorder {
 public:
  /// Opens the log. @param file  empty: nothing is kept. Throws std::invalid_argument if it cannot be written.
  explicit Recorder(const std::string& file);
  /// Writes the first lines. Throws as above.
  void begin(const CommandLogHeader& header);

  /// Inputs that the world has taken. Those that were refused or did nothing are left out.
  /// @param done  of each command, whether it had an effect
  void record(const World& world, const StepInputs& inputs, const std::vector<bool>& done, Announcer& announcer);
  /// After each step.
  void check(const World& world);
  void end(const World& world);

  /// Tries again what could not be written, once a second.
  void flush(Announcer& announcer);

  [[nodiscard]] bool on() const { return log_.has_value(); }
  [[nodiscard]] bool failed() const { return log_ && log_->failed(); }
  [[nodiscard]] std::optional<CommandLogState> state() const;

 private:
  void watch(Announcer& announcer);
  void require_writable() const;

  std::optional<CommandLogWriter> log_;
  bool fault_told_ = false;
  double next_check_ = 0.0;                         ///< s, simulated
  std::optional<std::uint64_t> checked_, changed_;  ///< steps made at the last check, at the last inputs
  std::int64_t next_flush_ns_ = 0;                  ///< wall clock
};

}  // namespace pelagos
