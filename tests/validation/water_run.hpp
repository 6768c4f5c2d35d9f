#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "physics/step_sums.hpp"
#include "physics/water_step.hpp"

namespace pelagos::validation {

/// A solver by the name that the server and the bench know it by, with its tolerances.
struct SolverChoice {
  std::string name = "corrected";
  double tolerance = 0.0;  ///< of both constraints, fraction of the rest density; 0: the solver's own
};

/// Particles on a lattice with velocities: the start of a case.
struct Start {
  std::vector<Float4> positions, velocities;  ///< m, m/s; velocities may be empty: at rest
  std::vector<std::uint8_t> phase;            ///< may be empty: all water
};

/// What a run cost and how well it held the water together.
struct RunCost {
  std::size_t particles = 0;
  std::int64_t steps = 0;
  double simulated_s = 0, wall_s = 0;
  double density_iterations = 0, velocity_iterations = 0;  ///< means by step
  double density_error = 0, density_error_peak = 0;        ///< mean of max(delta - 1, 0): its mean over steps, its peak
  double largest_density = 0;
  std::int64_t unconverged_steps = 0;
  [[nodiscard]] double wall_per_simulated() const { return wall_s / simulated_s; }
};

/// @param wall_s  s, spent on the steps
[[nodiscard]] RunCost run_cost(const StepSums& sums, std::size_t particles, double wall_s);

/// Water advanced as the server does it: adaptive steps, landing on the times that are asked for.
class WaterRun {
 public:
  WaterRun(int threads, FluidParameters parameters, const SolverChoice& solver, const Start& start);

  /// Position-only relaxation before time zero.
  void settle(int steps) { settle_fluid(*pool_, state_, steps); }
  /// Advances to `time`, calling `each` after every step (may be empty).
  void advance_to(double time, const std::function<void()>& each = {});
  /// Longest step in units of sqrt(d/g) (default 0.07; standard gravity where there is none; less in deep water, as the
  /// server has it) and CFL number (default
  /// 0.4). Where viscosity asks for a shorter one, nu dt / d^2 <= 0.1, that holds.
  void limit_steps(double factor, double cfl);

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const FluidState& state() const { return state_; }
  [[nodiscard]] FluidState& state() { return state_; }
  [[nodiscard]] TaskPool& pool() { return *pool_; }
  [[nodiscard]] const StepReport& last() const { return last_; }
  [[nodiscard]] RunCost cost() const;
  [[nodiscard]] StepReport measure();

 private:
  void step(double dt);

  std::unique_ptr<TaskPool> pool_;
  double layers_;  ///< depth at the start, in spacings
  FluidState state_;
  StepReport last_;
  StepSums sums_;
  std::size_t particles_ = 0;
  double wall_s_ = 0;
  double time_ = 0, max_step_ = 0, cfl_ = 0.4, speed_ = 0;
};

/// Parameters of water in a patch from the origin to `size` (m), standard gravity; viscosity negative: the
/// solver's default, filled in by WaterRun. So it does for oil, with the same kinematic viscosity.
[[nodiscard]] FluidParameters patch_parameters(const std::array<double, 3>& size, double spacing,
                                               const std::array<Edge, 3>& edges);

/// Lattice points at d/2, 3d/2, ... (mirrored and periodic axes) or d, 2d, ... (walls) that fill `size` from the
/// patch's lower corner.
[[nodiscard]] Start fill_block(const FluidParameters& parameters, const std::array<double, 3>& size);

}  // namespace pelagos::validation
