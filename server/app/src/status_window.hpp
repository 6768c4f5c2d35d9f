#pragma once

#include <cstdint>

#include "physics/step_report.hpp"
#include "values/status.hpp"

namespace pelagos {

/// Means over a stretch of wall time, and over the whole run.
struct RunningMeans {
  double wall_s = 0, simulated_s = 0, busy_s = 0;
  std::uint64_t steps = 0, unconverged_steps = 0;
  double density_error = 0, density_iterations = 0, divergence_iterations = 0, time_step = 0;  ///< sums over steps
  double density_error_peak = 0, step_ms_peak = 0, largest_density_peak = 0;

  void add(const StepReport& report, double busy_seconds);
  [[nodiscard]] double mean(double sum) const { return steps > 0 ? sum / static_cast<double>(steps) : 0.0; }
  [[nodiscard]] double real_time_factor() const { return wall_s > 0 ? simulated_s / wall_s : 0.0; }
  [[nodiscard]] double achievable_real_time_factor() const { return busy_s > 0 ? simulated_s / busy_s : 0.0; }
  [[nodiscard]] double step_ms() const { return steps > 0 ? busy_s * 1e3 / static_cast<double>(steps) : 0.0; }
};

/// Collects step reports and turns them into the status of the last whole second.
class StatusWindow {
 public:
  explicit StatusWindow(std::int64_t now_ns) : window_start_ns_(now_ns), run_start_ns_(now_ns) {}

  void add(const StepReport& report, double busy_seconds);

  /// If a second has passed since the last time: writes its figures into `status` and starts the next. True if so.
  bool roll(std::int64_t now_ns, ServerStatus& status);

  /// The whole run up to now.
  [[nodiscard]] RunningMeans whole_run(std::int64_t now_ns) const;
  [[nodiscard]] double lowest_real_time_factor() const { return lowest_; }  ///< of any whole second after the first

  /// Time spent paused does not count.
  void skip_to(std::int64_t now_ns);

 private:
  RunningMeans window_, run_;
  std::int64_t window_start_ns_, run_start_ns_;
  double lowest_ = 0.0;
  int windows_ = 0;
};

}  // namespace pelagos
