#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/coupling.hpp"
#include "physics/pair_passes.hpp"
#include "physics/step_report.hpp"

namespace pelagos {

/// How the two constraints are iterated.
enum class SolveMethod {
  kConjugateGradient,  ///< projected conjugate gradients with a filtered warm start
  kJacobi,             ///< damped Jacobi with clamped accumulated pressure and warm start
  kPaper,              ///< literal: damped Jacobi, increments clamped at zero, cold start
};

struct SolveSettings {
  SolveMethod method = SolveMethod::kConjugateGradient;
  double tolerance = 3e-4;  ///< on the mean residual, fraction of the rest density, > 0
  int min_iterations = 2;
  int max_iterations = 100;
  double jacobi_damping = 0.5;
  double warm_start = 1.0;  ///< share of the carried pressure that a warm solve starts from, 0 to 1
};

/// Both constraints are one problem: minimise 1/2 p'Ap - b'p over p >= 0, with A = J J' symmetric and semidefinite.
struct ConstraintProblem {
  const PairData* data = nullptr;
  const Gradients* gradients = nullptr;
  std::span<const float> source;          ///< b, no unit
  float warm_factor = 0.0F;               ///< (dt / previous dt)^2; 0 starts cold
  const BodyCoupling* bodies = nullptr;   ///< that answer the pressure; null: none does
  double particle_mass = 0.0;             ///< kg, rho_ref V; only where bodies answer
  std::span<const std::uint32_t> held{};  ///< particles that the pressure does not move; their rows have alpha = 0
  std::span<const float> given{};         ///< m^2, their pressures; empty: none
};

/// Arrays of a solve, kept between steps to avoid allocation.
struct SolveWorkspace {
  std::vector<float> pressure, start, residual, direction, image;
  std::vector<Float4> displacement, trial;
  std::vector<BodyMotion> answers;
};

/// Solves a constraint.
/// @param memory  in: warm start carried with the particles, m^2; out: the filtered one for the next step
/// @return the report; work.displacement holds u = -J' p in m. Not bounded here.
/// A step's pressure also holds its one-off repair of density; carrying that over would pump energy, so the memory
/// follows the pressure with a filter: m = p + 0.8 (p_start - p). Reductions run in a fixed order: the same bits for
/// any number of threads.
[[nodiscard]] SolveReport solve_constraint(TaskPool& pool, const ConstraintProblem& problem,
                                           const SolveSettings& settings, std::span<float> memory, SolveWorkspace& work,
                                           std::uint32_t& pair_passes);

}  // namespace pelagos
