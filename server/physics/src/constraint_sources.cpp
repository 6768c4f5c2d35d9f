#include "constraint_sources.hpp"

#include <algorithm>

#include "particle_blocks.hpp"

namespace pelagos {

void set_compression(TaskPool& pool, std::span<const float> density, std::span<float> source) {
  for_each_entry(pool, density.size(), [&](std::size_t i) { source[i] = density[i] - 1.0F; });
}

void set_predicted_compression(TaskPool& pool, float dt, std::span<const float> density, std::span<float> source) {
  for_each_entry(pool, density.size(), [&](std::size_t i) { source[i] = dt * source[i] + density[i] - 1.0F; });
}

void set_divergence(TaskPool& pool, float dt, bool clamped, std::span<float> source) {
  for_each_entry(pool, source.size(),
                 [&](std::size_t i) { source[i] = dt * (clamped ? std::max(source[i], 0.0F) : source[i]); });
}

void set_divergence_and_excess(TaskPool& pool, float dt, float allowed, float share, std::span<const float> density,
                               std::span<float> source) {
  for_each_entry(pool, density.size(), [&](std::size_t i) {
    source[i] = dt * source[i] + share * std::max(density[i] - 1.0F - allowed, 0.0F);
  });
}

double sum_compression(TaskPool& pool, std::span<const float> density) {
  return sum_blocks(pool, density.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += static_cast<double>(std::max(density[i] - 1.0F, 0.0F));
    return sum;
  });
}

}  // namespace pelagos
