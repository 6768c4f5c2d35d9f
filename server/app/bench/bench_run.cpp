#include "bench_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "command_queue.hpp"
#include "fields/field_hash.hpp"
#include "machine.hpp"
#include "monotonic_clock.hpp"
#include "physics/step_sums.hpp"
#include "simulation/state_file.hpp"
#include "simulation/world.hpp"
#include "values/snapshot.hpp"

namespace pelagos {

namespace {

/// Stages that are pair loops, for the cost by pair and pass.
constexpr Stage kPairStages[] = {Stage::kDensity,         Stage::kDensitySolve, Stage::kCorrectGradients,
                                 Stage::kDivergenceSolve, Stage::kFilter,       Stage::kAcceleration};

void fill(const StepSums& sums, const EnergyWatch& energy, BenchResult& result) {
  result.steps = static_cast<std::int64_t>(sums.steps);
  result.density_iterations_mean = sums.mean(sums.density_iterations);
  result.divergence_iterations_mean = sums.mean(sums.divergence_iterations);
  result.density_error_mean = sums.mean(sums.density_error);
  result.density_error_peak = sums.density_error_peak;
  result.largest_density_peak = sums.largest_density_peak;
  result.energy_rise_peak = energy.largest_rise();
  result.unconverged_steps = static_cast<std::int64_t>(sums.unconverged_steps);
  result.outside_peak = sums.outside_peak;
  result.not_finite_peak = sums.not_finite_peak;
  double pair_ns = 0.0;
  for (const Stage stage : kPairStages) pair_ns += static_cast<double>(sums.times.ns[static_cast<std::size_t>(stage)]);
  result.ns_per_pair_pass = sums.pair_visits > 0.0 ? pair_ns / sums.pair_visits : 0.0;
  for (std::size_t s = 0; s < kStageCount; ++s)
    result.stages_ms[s] = sums.mean(static_cast<double>(sums.times.ns[s])) * 1e-6;
}

StepInputs due_events(CommandQueue& events, double time) {
  std::vector<QueuedCommand> due;
  events.take(time, due);
  StepInputs inputs;
  for (QueuedCommand& event : due) inputs.commands.push_back(std::move(event.given));
  return inputs;
}

/// What a saved state costs; the world is afterwards as it was.
void measure_state(World& world, BenchResult& result) {
  const std::int64_t begin = monotonic_ns();
  const std::vector<std::byte> file = save_state(world);
  const std::int64_t saved = monotonic_ns();
  if (const auto refusal = load_state(file, world)) throw std::logic_error(to_string(*refusal));
  result.load_ms = static_cast<double>(monotonic_ns() - saved) * 1e-6;
  result.save_ms = static_cast<double>(saved - begin) * 1e-6;
  result.state_bytes = file.size();
}

}  // namespace

BenchResult run_bench(const Scene& scene, const BenchOptions& options, const std::function<void(double)>& progress) {
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  World world(scene, {options.threads, monotonic_ns, [&](double) { return !stopped(); }});
  StepSums sums;
  EnergyWatch energy(world.energy(world.measure()));
  Snapshot snapshot;
  const std::int64_t begin = monotonic_ns();
  std::int64_t steps = 0;
  const auto part_done = [&] {
    return options.steps > 0 ? static_cast<double>(steps) / static_cast<double>(options.steps)
                             : world.time() / options.seconds;
  };
  CommandQueue events(scene.events);
  while (part_done() < 1.0 - 1e-9 && !stopped()) {
    const StepInputs inputs = due_events(events, world.time());  // nobody could resume: a pause does nothing
    WorldStep step = world.advance(inputs);
    for (std::size_t k = 0; k < step.outcomes.size(); ++k)
      if (step.outcomes[k].refusal)
        throw std::runtime_error(inputs.commands[k].source + ": " + to_string(*step.outcomes[k].refusal));
    if (options.surface && step.frame_reached) world.take_frame(snapshot, step.report);
    sums.add(step.report);
    energy.add(world.energy(step.report));
    ++steps;
    if (progress && steps % 16 == 0) progress(part_done());
  }
  BenchResult result;
  fill(sums, energy, result);
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
