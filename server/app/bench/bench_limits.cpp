#include "bench_limits.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "monotonic_clock.hpp"
#include "physics/machine_limits.hpp"
#include "simulation/world.hpp"

namespace pelagos {

namespace {

constexpr int kTries = 30;
constexpr std::size_t kMemoryBytes = 512U << 20U;

/// What a pass of a solve reads in order: an index and a kept gradient for each slot.
std::size_t bytes_of_pass(const FluidState& fluid) {
  const auto& words = fluid.gradients.own.words;
  return fluid.fluid_list.slots.size() * sizeof(std::int32_t) + words.size() * sizeof(words[0]);
}

/// Shortest wall time of f(), ns.
template <class F>
double best_ns(F&& f) {
  volatile float keep = 0.0F;
  double best = std::numeric_limits<double>::max();
  for (int k = 0; k < kTries; ++k) {
    const std::int64_t begin = monotonic_ns();
    keep = f();
    best = std::min(best, static_cast<double>(std::max<std::int64_t>(monotonic_ns() - begin, 1)));
  }
  static_cast<void>(keep);
  return best;
}

double read_gb_s(TaskPool& pool, std::size_t bytes) {
  const std::vector<float> values(bytes / sizeof(float), 1.0F);
  return static_cast<double>(bytes) / best_ns([&] { return read_all(pool, values); });
}

}  // namespace

BenchLimits measure_limits(const Scene& scene, int threads, int steps) {
  World world(scene, {threads, monotonic_ns, {}});
  for (int k = 0; k < steps; ++k) world.advance();
  const FluidState& fluid = world.fluid();
  TaskPool pool(threads);
  BenchLimits limits;
  limits.particles = fluid.particles.count;
  limits.slots = fluid.fluid_list.slots.size();
  limits.pass_bytes = bytes_of_pass(fluid);
  constexpr std::size_t kBlocks = 64, kRounds = 20000;
  limits.multiply_add_gflops =
      multiply_add_operations(kBlocks, kRounds) / best_ns([&] { return multiply_add(pool, kBlocks, kRounds); });
  limits.memory_read_gb_s = read_gb_s(pool, kMemoryBytes);
  limits.cached_read_gb_s = read_gb_s(pool, limits.pass_bytes);
  limits.gather_ns_per_slot =
      best_ns([&] { return gather_all(pool, fluid.fluid_list, fluid.particles.position.data()); }) /
      static_cast<double>(std::max<std::size_t>(limits.slots, 1));
  return limits;
}

}  // namespace pelagos
