#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "physics/step_sums.hpp"
#include "physics/water_step.hpp"

namespace pelagos::hard {

/// The solvers that every hard case runs with, by the names of the server and the bench.
inline const std::vector<std::string> kSolvers = {"hybrid", "dfsph", "pbf", "corrected"};

/// The worst of a run, for judging whether it held.
struct Outcome {
  int steps = 0;
  std::uint32_t not_finite = 0, outside = 0;  ///< most in any step
  std::int64_t capped = 0;                    ///< corrections that met their bound, all steps
  int unconverged = 0;                        ///< steps in which a solve met its iteration bound
  double density_error = 0;                   ///< largest mean of max(delta - 1, 0)
  double mean_density_error = 0;              ///< its mean over the steps
  double largest_density = 0;                 ///< delta
  double energy_rise = 0;         ///< largest rise over the lowest energy before, fraction of the energy at the start
  double density_iterations = 0;  ///< means by step
  double velocity_iterations = 0;
  double largest_speed = 0;   ///< m/s
  double rms_speed = 0;       ///< m/s, of the last step
  double late_rms_speed = 0;  ///< m/s, largest in the second half of the run so far
  [[nodiscard]] bool sound() const { return not_finite == 0 && outside == 0; }
};

/// Water in a patch advanced step by step with a solver by its name, and what became of it.
class HardWater {
 public:
  /// @param layers  depth that settings and steps suit, as the server has them; 0: shallow
  HardWater(const FluidParameters& parameters, const std::vector<Float4>& positions, int threads = 1,
            const std::vector<std::uint8_t>& phase = {}, int layers = 0);

  /// Advances by dt and takes note. Stops noting once a value is not finite.
  StepReport step(double dt);
  /// Steps of min(factor sqrt(d/g), cfl d / speed) until `time` has gone by, or something is not finite. A tenth of a
  /// full step at least, so that a run ends. @param cfl  0: steps of one size
  void run(double time, double factor, double cfl);
  void settle(int steps);
  /// The energy that rises are measured against, from now on.
  void start_watch();

  /// s, sqrt(d/g); with standard gravity where there is none
  [[nodiscard]] double step_unit() const;
  [[nodiscard]] Outcome outcome() const;
  /// Of all steps so far.
  [[nodiscard]] const StepSums& sums() const { return sums_; }
  [[nodiscard]] FluidState& state() { return state_; }
  [[nodiscard]] TaskPool& pool() { return pool_; }
  [[nodiscard]] double mean_height() const;
  /// m/s, the largest of the last step
  [[nodiscard]] double speed() const { return speed_; }
  /// Every identity once: nobody lost, nobody doubled.
  [[nodiscard]] bool all_there() const;

 private:
  void note(const StepReport& report);
  [[nodiscard]] bool broken() const { return not_finite_ > 0; }

  TaskPool pool_;
  FluidState state_;
  StepSums sums_;
  EnergyWatch energy_;
  std::uint32_t not_finite_ = 0;
  int steps_broken_ = 0;
  std::vector<double> rms_;
  double speed_ = 0;
  double step_factor_;  ///< on every longest step
};

/// A patch from the origin, m, with the named solver at a tolerance for both constraints; viscosity as the server's
/// default for it.
[[nodiscard]] FluidParameters tank_with(const std::string& solver, const std::array<double, 3>& size, double spacing,
                                        double tolerance = 3e-4);

/// n[0] x n[1] x n[2] points at first, first + spacing, ...
[[nodiscard]] std::vector<Float4> block(const std::array<int, 3>& n, double spacing,
                                        const std::array<double, 3>& first);

/// A dam break of about 2,000 particles: 16 x 8 x 16 in a patch three times as long, spacing 0.05 m.
[[nodiscard]] HardWater small_dam(const std::string& solver, double tolerance = 3e-4);

/// The same, its upper quarter oil of so many times the water's density.
[[nodiscard]] HardWater oil_dam(const std::string& solver, double density_ratio, int threads = 1);

/// Still water of so many layers, 9 x 9 wide, walls all around, settled; spacing 0.05 m.
[[nodiscard]] HardWater still_column(const std::string& solver, int layers, double tolerance);

/// Still water of so many layers in a box 40 spacings long and 4 wide without sides (periodic) over a mirror, from the
/// lattice; spacing 0.05 m.
[[nodiscard]] HardWater still_sea(const std::string& solver, int layers, double tolerance);

/// A few hundred to two thousand particles that slosh to and fro: a slab higher at one end.
[[nodiscard]] HardWater sloshing_tank(const std::string& solver);

}  // namespace pelagos::hard
