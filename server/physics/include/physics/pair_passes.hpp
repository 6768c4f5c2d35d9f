#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/ghosts.hpp"
#include "physics/neighbors.hpp"
#include "physics/particles.hpp"
#include "physics/phases.hpp"
#include "physics/solids.hpp"
#include "physics/task_pool.hpp"

namespace pelagos {

// The pair loops of a step. Notation (volume form; all fluid particles have the volume V):
//   delta_i  = sum_j V W_ij + sum_b V_b W_ib                                 paper eq. 4 and 36, divided by rho0
//   (J v)_i  = sum_j (v_i - v_j).a_ij + sum_b (v_i - v_b).a_ib = d delta_i / dt             paper eq. 5, other sign
//   (J'p)_i  = p_i S_i - sum_j p_j a_ji,   S_i = sum_j a_ij + sum_b a_ib        paper eq. 20 and 30; adjoint of J
//   alpha_i  = 1 / (|S_i|^2 + sum_j |a_ij|^2) = 1 / diag(J J')
// The gradients a_ij are one of two:
//   plain      a_ij = V grad W_ij, so that -a_ji = a_ij
//   corrected  a_ij = V B_i grad W_ij, where B_i is the inverse of the particle's moment matrix (Bonet and Lok 1999):
//              J is then exact for every velocity field that is linear in space, at the surface and in disorder too.
// In both cases J' is the adjoint of J, so the pressure neither adds nor removes energy.
// With two phases J' p is weighed by the mobilities w_i (see phases.hpp), and alpha_i is divided by the largest w of
// the particle and its neighbours. That is a lower bound of 1 / diag(J W J'), stable at any ratio of densities.
// The paper prints alpha with the opposite sign (eq. 19, 37); with the forces of eq. 20 it has to be positive.
// J does not change while a constraint is solved, so its gradients are computed once and kept, in half precision where
// the machine has it (relative error 5e-4; both particles of a pair round the same numbers, so momentum is conserved to
// rounding). Every pass writes only the entries of its own particles: the same bits for any number of threads. Arrays
// that a pass gathers hold the images of mirrored and periodic faces behind the particles (see ghosts.hpp) and must be
// up to date there.

/// Gradients times the particle spacing (no unit) of every slot of a neighbour list: x, y, z for each lane.
struct GradientCache {
  std::vector<std::uint32_t> words;  ///< raw storage; half or single precision, as the instruction set has it
};

/// The discrete J of one state, as both constraints need it.
struct Gradients {
  GradientCache own;         ///< a_ij
  GradientCache other;       ///< -a_ji where that differs from a_ij: corrected ones, and near solids
  bool corrected = false;    ///< whether `other` is used away from solids
  std::vector<Float4> sum;   ///< [padded] x, y, z: S_i, 1/m
  std::vector<Float4> wall;  ///< [padded] x, y, z: sum_b a_ib (1/m); w: sum_b v_b.a_ib (1/s)
  std::array<std::vector<Float4>, SolidPlanes::kSlots> solid_wall;  ///< [padded] the share of `wall` by slot, 1/m
  std::vector<float> alpha;     ///< [padded] m^2; 0 for a particle without neighbours
  std::vector<float> mobility;  ///< [padded] the largest w among the particle and its neighbours; two phases only
};

/// Symmetric matrices B_i (no unit), as two records that pair loops gather.
struct Corrections {
  std::vector<Float4> first;   ///< xx, xy, xz, yy
  std::vector<Float4> second;  ///< yz, zz, weight of the correction (0: B is the unit matrix, 1: the full inverse), -
};

/// What all passes read.
struct PairData {
  std::size_t count = 0;             ///< fluid particles
  const Float4* position = nullptr;  ///< [padded] the far dummy included
  const NeighborList* fluid = nullptr;
  const NeighborList* boundary = nullptr;
  const BoundaryParticles* walls = nullptr;
  const Ghosts* ghosts = nullptr;       ///< null without images
  bool walls_move = false;              ///< false: wall velocities are not even read
  float support_radius = 0;             ///< m
  float volume = 0;                     ///< m^3, V
  float spacing = 0;                    ///< m, d
  const PhasePair* phases = nullptr;    ///< null with one phase; else position.w tells them apart
  const SolidPlanes* solids = nullptr;  ///< null without
};

/// Density and plain gradients of every particle.
void compute_density(TaskPool& pool, const PairData& data, std::span<float> delta, Gradients& gradients);

/// The same, and the correction matrices:
///   M_i = -sum_j V x_ij grad W_ij^T - sum_b V_b x_ib grad W_ib^T,   B_i = w M_i^-1 + (1 - w) I,
///   w = smoothstep((det M_i - 0.05) / 0.15) max(0, 1 - 10 sum_b V_b W_ib).
/// w is 0 for particles with hardly any neighbours, whose M is nearly singular. It is 0 at sampled walls too: the
/// corrected J v is not the rate of the sampled density, so a flow with J v = 0 may compress the water. Between walls
/// the repair would then lift the water again and again as it runs down along them: still water 15 layers deep gains 5
/// % of its energy and 60 layers 12 %; with w = 0 there it gains 0.1 %.
void compute_corrections(TaskPool& pool, const PairData& data, std::span<float> delta, Gradients& gradients,
                         Corrections& corrections);

/// Turns plain gradients into corrected ones.
void compute_corrected_gradients(TaskPool& pool, const PairData& data, const Corrections& corrections,
                                 Gradients& gradients);

/// out = -J' p, with two phases -W J' p: a displacement in m for p in m^2.
void apply_pressure(TaskPool& pool, const PairData& data, const Gradients& gradients, std::span<const float> pressure,
                    std::span<Float4> displacement);

/// out = J v, 1/s for m/s (no unit for displacements). With `moving_walls` the walls' own velocity counts.
void compute_rate(TaskPool& pool, const PairData& data, const Gradients& gradients, std::span<const Float4> velocity,
                  bool moving_walls, std::span<float> rate);

/// Velocity gradients G_i = sum_j V (v_j - v_i) (B_i grad W_ij)^T of the corrected gradients, 1/s. Row a of particle i
/// is in row[a][i], x, y, z; its w holds v_a, so that the filter gathers both at once.
///
/// Weak rotation is left out: G' = G - c (G - G^T) / 2, c = r^2 / (r^2 + 2 G:G) with the rate r. The filter leaves
/// alone what G' holds, so with r = 0 eddies of a few spacings live for ever, and calm water stirs itself. Waves have
/// no rotation; wakes and spinning water turn faster than r.
struct VelocityGradients {
  std::array<std::vector<Float4>, 3> row;
};
/// @param corrections  those of `gradients`; near solids they are read again
/// @param weak_rate  r, 1/s
void compute_velocity_gradients(TaskPool& pool, const PairData& data, const Gradients& gradients,
                                const Corrections& corrections, std::span<const Float4> velocity, float weak_rate,
                                VelocityGradients& out);

/// What the filter takes out of the velocities: sum_j V W_ij [v_j - v_i + (G_i + G_j)/2 (x_i - x_j)], m/s. Zero for
/// velocities that are linear in space, less their weak rotation; antisymmetric in each pair, so momentum stays.
/// Between two phases each particle takes the share rho0_lighter / rho0_i, for the same reason. The pass has the kernel
/// at hand, so it gives the densities at these positions as well.
struct FilterChange {
  std::vector<Float4> all;                                     ///< [padded] m/s
  std::array<std::vector<Float4>, SolidPlanes::kSlots> solid;  ///< [padded] the share of the solids' images, by slot
};
void compute_filter(TaskPool& pool, const PairData& data, const VelocityGradients& gradients, FilterChange& change,
                    std::span<float> delta);

/// Gravity and viscosity: a = g + nu 2 (dim + 2) sum_j V (v_ij . x_ij) / (x_ij^2 + 1e-6 R^2) grad W_ij   (paper eq. 6,
/// 7, which add 0.01 R^2 below the line: that alone takes 4 % of the viscosity at support 2 d). A fresh lattice of that
/// support resists a shear along its axes with 0.71 nu, disordered particles with about 0.95 nu. Walls are free of
/// friction. @param delta  out, the densities at these positions; may be empty
void compute_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float viscosity,
                          float gravity, std::span<Float4> acceleration, std::span<float> delta = {});

/// The same with two phases (data.phases): a = g + w_i 2 (dim + 2) sum_j V nu_ij (...) grad W_ij with nu_ij = mu_ij /
/// rho_ref, mu_ij the harmonic mean of the dynamic viscosities, which is what two layers in series have (Cleary and
/// Monaghan 1999, for conduction). The forces of a pair are equal and opposite.
void compute_phase_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float gravity,
                                std::span<Float4> acceleration, std::span<float> delta = {});

}  // namespace pelagos
