#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "physics/step_report.hpp"
#include "values/scene.hpp"

namespace pelagos {

struct BenchOptions {
  double seconds = 1.0;    ///< simulated, > 0
  std::int64_t steps = 0;  ///< > 0: so many steps instead
  int threads = 1;
  bool surface = false;                     ///< also extract the surface at each frame, as the server does
  const std::atomic<bool>* stop = nullptr;  ///< set from a signal handler: ends the run early
};

/// A run: speed and error together.
struct BenchResult {
  std::size_t particles = 0, boundary_particles = 0;
  std::int64_t steps = 0;
  double simulated_s = 0, wall_s = 0;
  double density_iterations_mean = 0, divergence_iterations_mean = 0;
  double density_error_mean = 0,
         density_error_peak = 0;  ///< over steps, of the mean over particles of max(delta - 1, 0)
  double largest_density_peak = 0;
  double energy_rise_peak = 0;  ///< largest rise above the lowest energy so far, as a part of the energy at the start
  double ns_per_pair_pass = 0;  ///< wall time of the pair loops by directed pair and pass
  bool stopped = false;         ///< before its end
  std::int64_t unconverged_steps = 0;
  std::uint64_t outside_peak = 0, not_finite_peak = 0;  ///< particles
  std::uint64_t peak_memory_bytes = 0;
  std::array<double, kStageCount> stages_ms{};  ///< mean by step
  std::uint64_t state_hash = 0;                 ///< of the water's positions and velocities
  std::uint64_t world_hash = 0;                 ///< of the whole state
  double save_ms = 0, load_ms = 0;              ///< of the state after the run, to bytes and back
  std::size_t state_bytes = 0;
  std::vector<std::string> start_notes;  ///< what is allowed, but hardly meant (World::start_notes)
};

/// Advances a scene without network or pacing. @param progress  called now and then with the part done, 0..1; may be
/// empty. Throws std::invalid_argument if the scene's bodies cannot be used.
[[nodiscard]] BenchResult run_bench(const Scene& scene, const BenchOptions& options,
                                    const std::function<void(double)>& progress);

}  // namespace pelagos
