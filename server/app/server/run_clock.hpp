#pragma once

#include <cstdint>
#include <optional>

#include "text/refusal.hpp"
#include "values/command.hpp"

namespace pelagos {

/// Whether a command steers the clock, and not what is simulated.
[[nodiscard]] bool steers_clock(const Command& command);

/// Whether simulated time goes on.
class RunClock {
 public:
  enum class State {
    kRunning,
    kPaused,    ///< time stands still
    kStepping,  ///< paused, but for some single steps that are still to be made
  };
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool paused() const { return state_ != State::kRunning; }

  /// What became of a command that steers the clock.
  struct Outcome {
    bool changed = false;
    std::optional<Refusal> refusal;
  };
  [[nodiscard]] Outcome apply(const Command& command);

  /// Counts a step that was made.
  void count_step();

 private:
  State state_ = State::kRunning;
  std::uint64_t steps_to_make_ = 0;
};

}  // namespace pelagos
