#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/neighbors.hpp"
#include "physics/particles.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

// The pair loops of a step. Notation (volume form; all fluid particles have the volume V):
//   delta_i  = sum_j V W_ij + sum_b V_b W_ib                                 paper eq. 4 and 36, divided by rho0
//   (J v)_i  = sum_j V (v_i - v_j).grad W_ij + sum_b V_b (v_i - v_b).grad W_ib = d delta_i / dt    paper eq. 5, other
//   sign (J'p)_i  = sum_j V (p_i + p_j) grad W_ij + p_i sum_b V_b grad W_ib         paper eq. 20 and 30; adjoint of J
//   alpha_i  = 1 / (|sum_j V grad W_ij + sum_b V_b grad W_ib|^2 + sum_j |V grad W_ij|^2) = 1 / diag(J J')
// The paper prints alpha with the opposite sign (eq. 19, 37); with the forces of eq. 20 it has to be positive.
// J does not change while a constraint is solved, so its gradients are computed once and kept in half precision
// (relative error 5e-4, the same for a pair and its mirror image: momentum is conserved to rounding all the same).
// Every pass writes only the entries of its own particles: the same bits for any number of threads.

/// Gradients V grad W_ij * particle spacing (no unit) of every slot of a neighbour list: x, y, z for each lane.
struct GradientCache {
  std::vector<std::uint32_t> words;  ///< raw storage; half or single precision, as the instruction set has it
};

/// What all passes read.
struct PairData {
  std::size_t count = 0;             ///< fluid particles
  const Float4* position = nullptr;  ///< [padded] the far dummy included
  const NeighborList* fluid = nullptr;
  const NeighborList* boundary = nullptr;
  const BoundaryParticles* walls = nullptr;
  bool walls_move = false;   ///< false: wall velocities are not even read
  float support_radius = 0;  ///< m
  float volume = 0;          ///< m^3, V
  float spacing = 0;         ///< m, d
};

/// delta, alpha (m^2) and the wall gradient of every particle; fills the gradient cache.
/// @param wall  [padded] x, y, z: sum_b V_b grad W_ib (1/m); w: sum_b V_b v_b.grad W_ib (1/s)
void compute_density(TaskPool& pool, const PairData& data, std::span<float> delta, std::span<float> alpha,
                     std::span<Float4> wall, GradientCache& cache);

/// out = -J' p: a displacement in m for p in m^2.
void apply_pressure(TaskPool& pool, const PairData& data, const GradientCache& cache, std::span<const Float4> wall,
                    std::span<const float> pressure, std::span<Float4> displacement);

/// out = J v, 1/s for m/s (no unit for displacements). With `moving_walls` the walls' own velocity counts.
void compute_rate(TaskPool& pool, const PairData& data, const GradientCache& cache, std::span<const Float4> wall,
                  std::span<const Float4> velocity, bool moving_walls, std::span<float> rate);

/// Gravity and viscosity: a = g + nu 2 (dim + 2) sum_j V (v_ij . x_ij) / (x_ij^2 + 0.01 R^2) grad W_ij   (paper eq. 6,
/// 7) Walls are free of friction.
void compute_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float viscosity,
                          float gravity, std::span<Float4> acceleration);

}  // namespace pelagos
