#pragma once

#include <cstdint>
#include <span>

#include "physics/particles.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

// Sums and products of one vector a particle. Only x, y and z count, unless said. Entry i of an output depends only on
// entries i of the inputs, and sums run block by block in order: the same bits for any number of threads.

/// values[i] = value, w included.
void fill_vectors(TaskPool& pool, const Float4& value, std::span<Float4> values);

/// to += factor from; w of `to` stays.
/// @param from  [count], not the same as `to`
void add_scaled_vectors(TaskPool& pool, float factor, std::span<const Float4> from, std::span<Float4> to);

/// to = factor a + b; w = 0. `to` may be a or b.
void combine_vectors(TaskPool& pool, float factor, std::span<const Float4> a, std::span<const Float4> b,
                     std::span<Float4> to);

/// sum_i a_i.b_i / divisor_i
/// @param divisor  [count]
[[nodiscard]] double weighted_product(TaskPool& pool, std::span<const Float4> a, std::span<const Float4> b,
                                      std::span<const float> divisor);

}  // namespace pelagos
