#include <algorithm>
#include <cmath>

#include "fluid_stages.hpp"

namespace pelagos {

// Conjugate gradients for (1 - dt L) v = v_old, where L v is the viscous acceleration. With the masses m_i = rho0_i V
// the forces m L are symmetric and negative, so 1 - dt L is self-adjoint and positive in the inner product sum_i m_i
// a_i.b_i, which is the one used here: no preconditioner, and as sum_i m_i r_i is zero to rounding for every residual,
// so is the change of momentum. The solve starts from v_old.

namespace {

constexpr double kTolerance = 1e-4;  ///< of the residual's norm, relative to the first
constexpr int kMostIterations = 50;

/// sum_i a_i.b_i / w_i, block by block in order.
double inner_product(TaskPool& pool, const FluidState& state, const std::vector<Float4>& a,
                     const std::vector<Float4>& b) {
  const std::size_t count = state.particles.count;
  std::vector<double> partial((count + kPointBlock - 1) / kPointBlock);
  pool.for_each_range(count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      sum += static_cast<double>((a[i].x * b[i].x + a[i].y * b[i].y + a[i].z * b[i].z) / state.phases.mobility[i]);
    partial[begin / kPointBlock] = sum;
  });
  double total = 0.0;
  for (const double sum : partial) total += sum;
  return total;
}

/// to = factor * a + b in x, y and z; w is zero.
void combine(TaskPool& pool, const FluidState& state, double factor, const std::vector<Float4>& a,
             const std::vector<Float4>& b, std::vector<Float4>& to) {
  const auto f = static_cast<float>(factor);
  for_each_particle(pool, state, [&](std::size_t i) {
    to[i] = {f * a[i].x + b[i].x, f * a[i].y + b[i].y, f * a[i].z + b[i].z, 0.0F};
  });
}

}  // namespace

void solve_viscosity(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  std::vector<Float4>&residual = state.viscosity.residual, &direction = state.viscosity.direction,
  &image = state.viscosity.image;
  const std::size_t size = data.ghosts ? extended_count(p.count, *data.ghosts) : padded_count(p.count);
  for (std::vector<Float4>* v : {&residual, &direction, &image}) v->assign(size, {});
  const auto viscous_acceleration = [&](std::vector<Float4>& velocity, std::vector<Float4>& out) {
    if (data.ghosts) extend_vectors(pool, *data.ghosts, velocity);
    compute_phase_acceleration(pool, data, velocity, 0.0F, out);
    ++report.pair_passes;
  };
  viscous_acceleration(p.velocity, residual);
  combine(pool, state, dt, residual, direction, residual);  // r = v_old - (1 - dt L) v_old
  double square = inner_product(pool, state, residual, residual), beta = 0.0;
  const double first = square;
  SolveReport& solve = report.viscosity;
  while (square > kTolerance * kTolerance * first && solve.iterations < kMostIterations) {
    combine(pool, state, beta, direction, residual, direction);
    viscous_acceleration(direction, image);
    combine(pool, state, -dt, image, direction, image);
    const double t = square / inner_product(pool, state, direction, image);
    combine(pool, state, t, direction, p.velocity, p.velocity);
    combine(pool, state, -t, image, residual, residual);
    const double next = inner_product(pool, state, residual, residual);
    beta = next / square;
    square = next;
    ++solve.iterations;
  }
  solve.residual = first > 0.0 ? std::sqrt(square / first) : 0.0;
  solve.converged = solve.residual <= kTolerance;
}

}  // namespace pelagos
