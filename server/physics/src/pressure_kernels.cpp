#include "pressure_kernels.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "particle_blocks.hpp"

namespace pelagos {

void press_compressed(TaskPool& pool, float damping, std::span<const float> alpha, std::span<const float> density,
                      std::span<float> pressure) {
  for_each_entry(pool, density.size(),
                 [&](std::size_t i) { pressure[i] = damping * alpha[i] * std::max(density[i] - 1.0F, 0.0F); });
}

void sweep(TaskPool& pool, float damping, std::span<const float> alpha, std::span<const float> residual,
           std::span<float> pressure) {
  for_each_entry(pool, pressure.size(),
                 [&](std::size_t i) { pressure[i] = std::max(0.0F, pressure[i] + damping * alpha[i] * residual[i]); });
}

void sweep_one_sided(TaskPool& pool, float damping, std::span<const float> alpha, std::span<const float> residual,
                     std::span<float> pressure) {
  for_each_entry(pool, pressure.size(),
                 [&](std::size_t i) { pressure[i] += damping * alpha[i] * std::max(0.0F, residual[i]); });
}

void start_pressure(TaskPool& pool, const WarmStart& warm, std::size_t count, SolveWorkspace& work) {
  const bool cold = !(warm.factor > 0.0F);
  for_each_entry(pool, count, [&](std::size_t i) {
    const bool carry = !cold && warm.alpha[i] > 0.0F && warm.source[i] > warm.thinnest;
    work.pressure[i] = work.start[i] = carry ? warm.factor * warm.memory[i] : 0.0F;
    work.direction[i] = work.image[i] = 0.0F;
    if (cold) work.displacement[i] = {};
  });
}

void remember_pressure(TaskPool& pool, float share, std::span<const float> pressure, std::span<const float> start,
                       std::span<float> memory) {
  for_each_entry(pool, pressure.size(), [&](std::size_t i) {
    const float p = pressure[i];
    memory[i] = start[i] > 0.0F ? p + share * (start[i] - p) : p;
  });
}

double sum_positive(TaskPool& pool, std::span<const float> residual) {
  std::vector<float> partial((residual.size() + kPointBlock - 1) / kPointBlock);
  pool.for_each_range(residual.size(), kPointBlock, [&](std::size_t begin, std::size_t end) {
    float sum = 0.0F;
    for (std::size_t i = begin; i < end; ++i) sum += std::max(0.0F, residual[i]);
    partial[begin / kPointBlock] = sum;
  });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

}  // namespace pelagos
