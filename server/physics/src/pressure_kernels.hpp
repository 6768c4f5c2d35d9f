#pragma once

#include <span>

#include "physics/constraint_solve.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

// Pointwise parts of the constraint solves: pressures p >= 0 (m^2) and residuals r (no unit). Entry i of an output
// depends only on entries i of the inputs: the same bits for any number of threads.

/// p = damping alpha max(delta - 1, 0): one correction that pushes only.
/// @param alpha     [count] m^2, the inverse diagonal
/// @param density   [count] delta
/// @param pressure  out, [count]
void press_compressed(TaskPool& pool, float damping, std::span<const float> alpha, std::span<const float> density,
                      std::span<float> pressure);

/// p = max(p + damping alpha r, 0): a damped Jacobi sweep with the pressure clamped.
void sweep(TaskPool& pool, float damping, std::span<const float> alpha, std::span<const float> residual,
           std::span<float> pressure);

/// p += damping alpha max(r, 0): the same with every increment clamped, so that no pressure is taken back.
void sweep_one_sided(TaskPool& pool, float damping, std::span<const float> alpha, std::span<const float> residual,
                     std::span<float> pressure);

/// What a solve starts from.
struct WarmStart {
  float factor;                   ///< on the memory; 0: cold
  float thinnest;                 ///< no particle with a source below starts warm
  std::span<const float> alpha;   ///< [count]
  std::span<const float> source;  ///< [count] b
  std::span<const float> memory;  ///< [count] m^2
};
/// p = start = factor memory where the particle has neighbours (alpha > 0) and b > thinnest, else 0; the last move and
/// its image are cleared, and of a cold start the displacement.
void start_pressure(TaskPool& pool, const WarmStart& warm, std::size_t count, SolveWorkspace& work);

/// The warm start of the next step: memory = p + share (start - p) where there was one (start > 0), else p.
void remember_pressure(TaskPool& pool, float share, std::span<const float> pressure, std::span<const float> start,
                       std::span<float> memory);

/// Sum of max(r, 0): in float within a block, in double over the blocks.
[[nodiscard]] double sum_positive(TaskPool& pool, std::span<const float> residual);

}  // namespace pelagos
