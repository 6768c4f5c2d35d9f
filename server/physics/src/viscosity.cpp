#include <algorithm>
#include <cmath>

#include "fluid_stages.hpp"
#include "vector_kernels.hpp"

namespace pelagos {

// Conjugate gradients for (1 - dt L) v = v_old, where L v is the viscous acceleration. With the masses m_i = rho0_i V
// the forces m L are symmetric and negative, so 1 - dt L is self-adjoint and positive in the inner product sum_i m_i
// a_i.b_i, which is the one used here: no preconditioner, and as sum_i m_i r_i is zero to rounding for every residual,
// so is the change of momentum. The solve starts from v_old.

namespace {

constexpr double kTolerance = 1e-4;  ///< of the residual's norm, relative to the first
constexpr int kMostIterations = 50;

}  // namespace

void solve_viscosity(TaskPool& pool, FluidState& state, double dt, StepReport& report) {
  FluidParticles& p = state.particles;
  const PairData data = pair_data(state);
  std::vector<Float4>&residual = state.viscosity.residual, &direction = state.viscosity.direction,
  &image = state.viscosity.image;
  const std::size_t size = data.ghosts ? extended_count(p.count, *data.ghosts) : padded_count(p.count);
  for (std::vector<Float4>* v : {&residual, &direction, &image}) v->assign(size, {});
  const std::span<const float> mobility = of_particles(state, state.phases.mobility);
  const auto inner_product = [&](const std::vector<Float4>& a, const std::vector<Float4>& b) {
    return weighted_product(pool, a, b, mobility);
  };
  const auto combine = [&](double factor, const std::vector<Float4>& a, const std::vector<Float4>& b,
                           std::vector<Float4>& to) {
    combine_vectors(pool, static_cast<float>(factor), a, b, of_particles(state, to));
  };
  const auto viscous_acceleration = [&](std::vector<Float4>& velocity, std::vector<Float4>& out) {
    if (data.ghosts) extend_vectors(pool, *data.ghosts, velocity);
    compute_phase_acceleration(pool, data, velocity, 0.0F, out);
    ++report.pair_passes;
  };
  viscous_acceleration(p.velocity, residual);
  combine(dt, residual, direction, residual);  // r = v_old - (1 - dt L) v_old
  double square = inner_product(residual, residual), beta = 0.0;
  const double first = square;
  SolveReport& solve = report.viscosity;
  while (square > kTolerance * kTolerance * first && solve.iterations < kMostIterations) {
    combine(beta, direction, residual, direction);
    viscous_acceleration(direction, image);
    combine(-dt, image, direction, image);
    const double t = square / inner_product(direction, image);
    combine(t, direction, p.velocity, p.velocity);
    combine(-t, image, residual, residual);
    const double next = inner_product(residual, residual);
    beta = next / square;
    square = next;
    ++solve.iterations;
  }
  solve.residual = first > 0.0 ? std::sqrt(square / first) : 0.0;
  solve.converged = solve.residual <= kTolerance;
}

}  // namespace pelagos
