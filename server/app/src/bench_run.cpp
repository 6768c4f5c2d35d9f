#include "bench_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "command_queue.hpp"
#include "fields/field_hash.hpp"
#include "machine.hpp"
#include "monotonic_clock.hpp"
#include "simulation/state_file.hpp"
#include "simulation/world.hpp"
#include "values/snapshot.hpp"

namespace pelagos {

namespace {

/// Stages that are pair loops, for the cost by pair and pass.
constexpr Stage kPairStages[] = {Stage::kDensity,         Stage::kDensitySolve, Stage::kCorrectGradients,
                                 Stage::kDivergenceSolve, Stage::kFilter,       Stage::kAcceleration};

/// Sums over the steps of a run.
class Tally {
 public:
  explicit Tally(double start_energy) : start_energy_(start_energy), lowest_energy_(start_energy) {}

  void add(const StepReport& report, double energy) {
    ++steps_;
    density_iterations_ += report.density.iterations;
    divergence_iterations_ += report.divergence.iterations;
    density_error_ += report.density_error;
    result_.density_error_peak = std::max(result_.density_error_peak, report.density_error);
    result_.largest_density_peak = std::max(result_.largest_density_peak, report.largest_density);
    result_.unconverged_steps += report.density.converged && report.divergence.converged ? 0 : 1;
    result_.outside_peak = std::max<std::uint64_t>(result_.outside_peak, report.outside);
    result_.not_finite_peak = std::max<std::uint64_t>(result_.not_finite_peak, report.not_finite);
    lowest_energy_ = std::min(lowest_energy_, energy);
    if (start_energy_ > 0.0)
      result_.energy_rise_peak = std::max(result_.energy_rise_peak, (energy - lowest_energy_) / start_energy_);
    pair_passes_ += static_cast<double>(report.pairs) * report.pair_passes;
    for (std::size_t s = 0; s < kStageCount; ++s) stage_ns_[s] += static_cast<double>(report.times.ns[s]);
  }

  [[nodiscard]] BenchResult finish() {
    const auto steps = static_cast<double>(std::max<std::int64_t>(steps_, 1));
    result_.steps = steps_;
    result_.density_iterations_mean = density_iterations_ / steps;
    result_.divergence_iterations_mean = divergence_iterations_ / steps;
    result_.density_error_mean = density_error_ / steps;
    double pair_ns = 0.0;
    for (const Stage stage : kPairStages) pair_ns += stage_ns_[static_cast<std::size_t>(stage)];
    result_.ns_per_pair_pass = pair_passes_ > 0.0 ? pair_ns / pair_passes_ : 0.0;
    for (std::size_t s = 0; s < kStageCount; ++s) result_.stages_ms[s] = stage_ns_[s] * 1e-6 / steps;
    return result_;
  }

 private:
  BenchResult result_;
  double start_energy_, lowest_energy_;
  std::int64_t steps_ = 0;
  double density_iterations_ = 0, divergence_iterations_ = 0, density_error_ = 0, pair_passes_ = 0;
  std::array<double, kStageCount> stage_ns_{};
};

/// What a saved state costs; the world is afterwards as it was.
void measure_state(World& world, BenchResult& result) {
  const std::int64_t begin = monotonic_ns();
  const std::vector<std::byte> file = save_state(world);
  const std::int64_t saved = monotonic_ns();
  if (const auto refusal = load_state(file, world)) throw std::logic_error(*refusal);
  result.load_ms = static_cast<double>(monotonic_ns() - saved) * 1e-6;
  result.save_ms = static_cast<double>(saved - begin) * 1e-6;
  result.state_bytes = file.size();
}

}  // namespace

BenchResult run_bench(const Scene& scene, const BenchOptions& options, const std::function<void(double)>& progress) {
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  World world(scene, {options.threads, monotonic_ns, [&](double) { return !stopped(); }});
  Tally tally(world.energy(world.measure()));
  Snapshot snapshot;
  const std::int64_t begin = monotonic_ns();
  std::int64_t steps = 0;
  const auto part_done = [&] {
    return options.steps > 0 ? static_cast<double>(steps) / static_cast<double>(options.steps)
                             : world.time() / options.seconds;
  };
  CommandQueue events(scene.events, scene.wind);
  std::vector<QueuedCommand> due;
  while (part_done() < 1.0 - 1e-9 && !stopped()) {
    events.take(world.time(), due);
    for (const QueuedCommand& event : due) {  // nobody could resume: a pause does nothing
      if (const auto refusal = world.apply(event.command)) throw std::runtime_error(event.source + ": " + *refusal);
    }
    WorldStep step = world.advance();
    if (options.surface && step.frame_reached) world.fill_snapshot(snapshot, step.report);
    tally.add(step.report, world.energy(step.report));
    ++steps;
    if (progress && steps % 16 == 0) progress(part_done());
  }
  BenchResult result = tally.finish();
  result.stopped = part_done() < 1.0 - 1e-9;
  result.wall_s = static_cast<double>(monotonic_ns() - begin) * 1e-9;
  result.simulated_s = world.time();
  result.particles = world.fluid().particles.count;
  result.boundary_particles = world.fluid().walls.count;
  result.peak_memory_bytes = peak_memory();
  result.state_hash = state_hash(world.fluid().particles);
  result.world_hash = hash_fields(world.state());
  measure_state(world, result);
  result.start_notes = world.start_notes();
  return result;
}

}  // namespace pelagos
