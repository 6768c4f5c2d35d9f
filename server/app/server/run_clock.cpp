#include "run_clock.hpp"

namespace pelagos {

bool steers_clock(const Command& command) {
  return std::holds_alternative<PauseSimulation>(command) || std::holds_alternative<ResumeSimulation>(command) ||
         std::holds_alternative<StepSimulation>(command);
}

RunClock::Outcome RunClock::apply(const Command& command) {
  if (std::holds_alternative<PauseSimulation>(command)) {
    const bool running = state_ == State::kRunning;
    if (running) state_ = State::kPaused;
    return {running, {}};
  }
  if (std::holds_alternative<ResumeSimulation>(command)) {
    const bool stood = paused();
    state_ = State::kRunning;
    steps_to_make_ = 0;
    return {stood, {}};
  }
  if (const auto* step = std::get_if<StepSimulation>(&command)) {
    if (!paused()) return {false, Refusal{"", "the simulation is running; pause it before stepping"}};
    steps_to_make_ += step->steps;
    if (steps_to_make_ > 0) state_ = State::kStepping;
    return {true, {}};
  }
  return {};
}

void RunClock::count_step() {
  if (state_ != State::kStepping) return;
  if (--steps_to_make_ == 0) state_ = State::kPaused;
}

}  // namespace pelagos
