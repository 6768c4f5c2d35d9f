#pragma once

#include <algorithm>
#include <cstdint>

#include "physics/step_report.hpp"

namespace pelagos {

/// Sums and extremes of the reports of many steps.
struct StepSums {
  std::uint64_t steps = 0, unconverged_steps = 0;  ///< of the latter a solve met its bound of iterations
  double simulated_s = 0.0;
  double density_error = 0.0;                                    ///< sum over steps
  double density_iterations = 0.0, divergence_iterations = 0.0;  ///< sums over steps
  double density_error_peak = 0.0, largest_density_peak = 0.0, largest_speed_peak = 0.0;
  std::uint32_t outside_peak = 0, not_finite_peak = 0;  ///< particles
  std::uint64_t capped = 0;                             ///< corrections that met their bound
  double pair_visits = 0.0;                             ///< directed pairs times passes
  StageTimes times;

  void add(const StepReport& report) {
    ++steps;
    simulated_s += report.dt;
    unconverged_steps += report.density.converged && report.divergence.converged ? 0 : 1;
    density_error += report.density_error;
    density_iterations += report.density.iterations;
    divergence_iterations += report.divergence.iterations;
    density_error_peak = std::max(density_error_peak, report.density_error);
    largest_density_peak = std::max(largest_density_peak, report.largest_density);
    largest_speed_peak = std::max(largest_speed_peak, report.largest_speed);
    outside_peak = std::max(outside_peak, report.outside);
    not_finite_peak = std::max(not_finite_peak, report.not_finite);
    capped += report.capped;
    pair_visits += static_cast<double>(report.pairs) * report.pair_passes;
    for (std::size_t stage = 0; stage < kStageCount; ++stage) times.ns[stage] += report.times.ns[stage];
  }

  /// A sum as a mean over the steps; 0 before the first.
  [[nodiscard]] double mean(double sum) const { return steps > 0 ? sum / static_cast<double>(steps) : 0.0; }
};

/// How far the energy of a water rises again after it has fallen.
class EnergyWatch {
 public:
  EnergyWatch() = default;
  /// @param start  J, kinetic and potential
  explicit EnergyWatch(double start) : start_(start), lowest_(start) {}

  void add(double energy) {
    lowest_ = std::min(lowest_, energy);
    if (start_ > 0.0) rise_ = std::max(rise_, (energy - lowest_) / start_);
  }
  /// Largest rise over the lowest energy before it, as a part of the energy at the start.
  [[nodiscard]] double largest_rise() const { return rise_; }

 private:
  double start_ = 0.0, lowest_ = 0.0, rise_ = 0.0;
};

}  // namespace pelagos
