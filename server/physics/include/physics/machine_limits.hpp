#pragma once

#include <cstddef>
#include <span>

#include "physics/neighbors.hpp"
#include "physics/particles.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

// Loops that do one thing only, for measuring what a machine can do at best: what the stages of a step are held
// against. Each returns a number that depends on all its work, so that no compiler drops it.

/// Reads `values` once, 64 bytes at a time.
[[nodiscard]] float read_all(TaskPool& pool, std::span<const float> values);

/// Goes through a neighbour list as the pair loops do and brings the 16-byte record of each slot, with one addition.
[[nodiscard]] float gather_all(TaskPool& pool, const NeighborList& list, const Float4* records);

/// Sixteen chains of independent multiply-adds on full vectors, `rounds` times in each of `blocks` blocks.
[[nodiscard]] float multiply_add(TaskPool& pool, std::size_t blocks, std::size_t rounds);

/// Floating-point operations of multiply_add(pool, blocks, rounds).
[[nodiscard]] double multiply_add_operations(std::size_t blocks, std::size_t rounds);

}  // namespace pelagos
