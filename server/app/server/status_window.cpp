#include "status_window.hpp"

#include <algorithm>

namespace pelagos {

namespace {
constexpr double kNanoseconds = 1e-9;
constexpr std::int64_t kWindowNs = 1'000'000'000;
}  // namespace

void RunningMeans::add(const StepReport& report, double busy_seconds) {
  StepSums::add(report);
  busy_s += busy_seconds;
  step_ms_peak = std::max(step_ms_peak, busy_seconds * 1e3);
}

void StatusWindow::add(const StepReport& report, double busy_seconds) {
  window_.add(report, busy_seconds);
  run_.add(report, busy_seconds);
}

bool StatusWindow::roll(std::int64_t now_ns, ServerStatus& status) {
  if (now_ns - window_start_ns_ < kWindowNs) return false;
  window_.wall_s = static_cast<double>(now_ns - window_start_ns_) * kNanoseconds;
  status.real_time_factor = window_.real_time_factor();
  status.achievable_real_time_factor = window_.achievable_real_time_factor();
  status.unconverged_steps = static_cast<std::uint32_t>(window_.unconverged_steps);
  if (window_.steps > 0) {
    status.step_ms = window_.step_ms();
    status.time_step = window_.mean(window_.simulated_s);
    status.density_error = window_.mean(window_.density_error);
    status.largest_density = window_.largest_density_peak;
    status.density_iterations = window_.mean(window_.density_iterations);
    status.divergence_iterations = window_.mean(window_.divergence_iterations);
    ++windows_;
    if (windows_ == 2) lowest_ = status.real_time_factor;  // the first second warms up
    if (windows_ > 2) lowest_ = std::min(lowest_, status.real_time_factor);
  }
  window_ = {};
  window_start_ns_ = now_ns;
  return true;
}

RunningMeans StatusWindow::whole_run(std::int64_t now_ns) const {
  RunningMeans run = run_;
  run.wall_s = static_cast<double>(now_ns - run_start_ns_) * kNanoseconds;
  return run;
}

void StatusWindow::skip_to(std::int64_t now_ns) {
  run_start_ns_ += now_ns - window_start_ns_;
  window_start_ns_ = now_ns;
  window_ = {};
}

}  // namespace pelagos
