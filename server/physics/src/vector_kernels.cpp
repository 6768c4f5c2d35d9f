#include "vector_kernels.hpp"

#include "particle_blocks.hpp"

namespace pelagos {

void fill_vectors(TaskPool& pool, const Float4& value, std::span<Float4> values) {
  for_each_entry(pool, values.size(), [&](std::size_t i) { values[i] = value; });
}

void add_scaled_vectors(TaskPool& pool, float factor, std::span<const Float4> from, std::span<Float4> to) {
  for_each_entry(pool, from.size(), [&](std::size_t i) {
    const Float4 &a = from[i], &b = to[i];
    to[i] = {b.x + factor * a.x, b.y + factor * a.y, b.z + factor * a.z, b.w};
  });
}

void combine_vectors(TaskPool& pool, float factor, std::span<const Float4> a, std::span<const Float4> b,
                     std::span<Float4> to) {
  for_each_entry(pool, to.size(), [&](std::size_t i) {
    to[i] = {factor * a[i].x + b[i].x, factor * a[i].y + b[i].y, factor * a[i].z + b[i].z, 0.0F};
  });
}

double weighted_product(TaskPool& pool, std::span<const Float4> a, std::span<const Float4> b,
                        std::span<const float> divisor) {
  return sum_blocks(pool, divisor.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      sum += static_cast<double>((a[i].x * b[i].x + a[i].y * b[i].y + a[i].z * b[i].z) / divisor[i]);
    return sum;
  });
}

}  // namespace pelagos
