#pragma once

#include <cstdint>

#include "physics/step_sums.hpp"
#include "values/status.hpp"

namespace pelagos {

/// The steps of a stretch of wall time, or of the whole run.
struct RunningMeans : StepSums {
  double wall_s = 0, busy_s = 0, step_ms_peak = 0;

  void add(const StepReport& report, double busy_seconds);
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
