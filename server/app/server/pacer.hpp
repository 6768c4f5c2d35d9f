#pragma once

#include <chrono>
#include <thread>

namespace pelagos {

/// Keeps simulated time in step with the wall clock. What cannot be kept up is given up: after a lag the simulation
/// goes on at the pace of the clock, it does not race to catch up.
class Pacer {
 public:
  explicit Pacer(double simulation_time) { restart(simulation_time); }

  /// Simulated and wall time agree now.
  void restart(double simulation_time) {
    wall_ = Clock::now();
    simulation_ = simulation_time;
  }

  /// Sleeps until the wall clock has come to `simulation_time`.
  void wait_for(double simulation_time) {
    const auto due = wall_ + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(simulation_time - simulation_));
    const auto now = Clock::now();
    if (now - due > kLargestLag) return restart(simulation_time);
    if (due > now) std::this_thread::sleep_until(due);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kLargestLag{200};
  Clock::time_point wall_;
  double simulation_ = 0.0;
};

}  // namespace pelagos
