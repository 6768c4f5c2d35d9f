#pragma once

#include <functional>

#include "water_run.hpp"

namespace pelagos::validation {

/// A regular wave of one wavelength in a box that is periodic along it, over a mirror or a sampled floor.
struct TravellingWave {
  double length = 60, depth = 10, amplitude = 1;  ///< m
  double spacing = 1;                             ///< m
  double slice = 6;                               ///< width in spacings
  bool sampled_floor = false;                     ///< particles instead of a mirror under it
  double viscosity = -1.0;                        ///< m^2/s; negative: the solver's default
};

struct TravellingResult {
  double amplitude = 1;  ///< over that at the start
  double loss = 0;       ///< share of the amplitude lost a period, mean
  double phase = 0;      ///< ahead of linear theory, periods a period
  double noise = 0;      ///< rms velocity that is not the wave's over the wave's
};

/// Runs for whole periods; `each` is called at the end of every one with the result so far, `moved` after each step
/// with the share done.
TravellingResult run_travelling(WaterRun& run, const TravellingWave& wave, int periods,
                                const std::function<void(int, const TravellingResult&)>& each,
                                const std::function<void(double)>& moved);

/// The water at the start.
[[nodiscard]] WaterRun start_travelling(int threads, const TravellingWave& wave, const SolverChoice& solver);

}  // namespace pelagos::validation
