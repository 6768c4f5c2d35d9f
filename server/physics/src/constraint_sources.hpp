#pragma once

#include <span>

#include "physics/task_pool.hpp"

namespace pelagos {

// Right-hand sides b of the constraints, particle by particle. Entry i of the output depends only on entries i of the
// inputs: the same bits for any number of threads. No unit, except where said.

/// b = delta - 1 of the density at hand.
/// @param density  [count] delta
/// @param source   out, [count]
void set_compression(TaskPool& pool, std::span<const float> density, std::span<float> source);

/// b = dt J v + delta - 1: the compression that a step of dt would reach.
/// @param source  in: J v, 1/s; out: b
void set_predicted_compression(TaskPool& pool, float dt, std::span<const float> density, std::span<float> source);

/// b = dt J v, or dt max(J v, 0) if `clamped`.
/// @param source  in: J v, 1/s; out: b
void set_divergence(TaskPool& pool, float dt, bool clamped, std::span<float> source);

/// b = dt J v + share max(delta - 1 - allowed, 0).
/// @param source  in: J v, 1/s; out: b
void set_divergence_and_excess(TaskPool& pool, float dt, float allowed, float share, std::span<const float> density,
                               std::span<float> source);

/// Sum of max(delta - 1, 0), block by block in order.
[[nodiscard]] double sum_compression(TaskPool& pool, std::span<const float> density);

}  // namespace pelagos
