#include "physics/constraint_solve.hpp"

#include <algorithm>
#include <cmath>

#include "pressure_kernels.hpp"
#include "solve_passes.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kBlock = 2048;
/// Warm starts are dropped where the water is this much thinner than at rest.
constexpr float kThinnest = -0.05F;
/// Weight of the old warm start in the new one.
constexpr float kMemory = 0.8F;
/// Bounds of the step scale that the projected direction is tried with.
constexpr float kSmallestStep = 0.1F, kLargestStep = 20.0F, kFirstStep = 0.7F;
constexpr int kRestarts = 3;

struct Totals {
  double error = 0, z_image = 0, r_direction = 0, s_image = 0;
  float longest = 3e38F;
};

/// Runs `pass(begin, end)` over blocks and adds their sums in order.
template <class Pass>
Totals reduce(TaskPool& pool, std::size_t count, Pass&& pass) {
  std::vector<SolveSums> partial((count + kBlock - 1) / kBlock);
  pool.for_each_range(count, kBlock,
                      [&](std::size_t begin, std::size_t end) { partial[begin / kBlock] = pass(begin, end); });
  Totals totals;
  for (const SolveSums& sums : partial) {
    totals.error += static_cast<double>(sums.error);
    totals.z_image += static_cast<double>(sums.z_image);
    totals.r_direction += static_cast<double>(sums.r_direction);
    totals.s_image += static_cast<double>(sums.s_image);
    totals.longest = std::min(totals.longest, sums.longest);
  }
  return totals;
}

/// One solve: the arrays and the pair passes bound together.
class Solver {
 public:
  Solver(TaskPool& pool, const ConstraintProblem& problem, SolveWorkspace& work, std::uint32_t& passes)
      : pool_(pool),
        problem_(problem),
        work_(work),
        passes_(passes),
        count_(problem.data->count),
        arrays_{problem.gradients->alpha.data(), problem.source.data(), work.pressure.data(),     work.residual.data(),
                work.direction.data(),           work.image.data(),     work.displacement.data(), work.trial.data()} {}

  /// Pressure and displacement of the warm start (or zero), and the residual that they leave.
  Totals start(std::span<const float> memory, float share) {
    const float factor = share * problem_.warm_factor;
    const bool warm = factor > 0.0F;
    start_pressure(pool_, {factor, kThinnest, problem_.gradients->alpha, problem_.source, memory}, count_, work_);
    for (std::size_t k = 0; k < problem_.given.size(); ++k)
      work_.pressure[problem_.held[k]] = work_.start[problem_.held[k]] = problem_.given[k];
    if (warm || !problem_.given.empty())
      refresh();
    else
      start_residuals(nullptr);
    return judge_all();
  }

  Totals judge_all() {
    return reduce(pool_, count_, [&](std::size_t b, std::size_t e) { return judge(b, e, arrays_); });
  }
  Totals direction(float beta, float step) {
    return reduce(pool_, count_,
                  [&](std::size_t b, std::size_t e) { return make_direction(b, e, arrays_, beta, step); });
  }
  /// w = -J's and q = A s: the only multiply.
  Totals multiply() {
    apply(work_.direction, work_.trial, work_.image);
    return reduce(pool_, count_, [&](std::size_t b, std::size_t e) { return set_image(b, e, arrays_, arrays_.image); });
  }
  Totals advance(float t, float inverse_step) {
    return reduce(pool_, count_, [&](std::size_t b, std::size_t e) { return move(b, e, arrays_, t, inverse_step); });
  }

  /// One damped Jacobi sweep with the accumulated pressure clamped at zero.
  Totals jacobi(float damping) {
    sweep(pool_, damping, problem_.gradients->alpha, first(work_.residual), first(work_.pressure));
    refresh();
    return judge_all();
  }
  /// The same with every increment clamped: what has been pressed is never released.
  Totals clamped_jacobi(float damping) {
    sweep_one_sided(pool_, damping, problem_.gradients->alpha, first(work_.residual), first(work_.pressure));
    refresh();
    return judge_compression();
  }
  /// The error of a one-sided stop: the mean of max(r, 0).
  Totals judge_compression() {
    Totals totals;
    totals.error = sum_positive(pool_, first(work_.residual));
    return totals;
  }

  void remember(std::span<float> memory) const {
    remember_pressure(pool_, kMemory, first(work_.pressure), work_.start, memory);
  }

  [[nodiscard]] double mean_error(const Totals& totals) const {
    return totals.error / static_cast<double>(std::max<std::size_t>(count_, 1));
  }

 private:
  /// The entries of the particles.
  [[nodiscard]] std::span<float> first(std::vector<float>& values) const { return {values.data(), count_}; }
  /// u = -J'p, rate = J u.
  void apply(std::span<float> pressure, std::span<Float4> displacement, std::span<float> rate) {
    const PairData& data = *problem_.data;
    if (data.ghosts) extend_scalars(pool_, *data.ghosts, pressure);
    apply_pressure(pool_, data, *problem_.gradients, pressure, displacement);
    for (const std::uint32_t i : problem_.held) displacement[i] = {};
    if (data.ghosts) extend_vectors(pool_, *data.ghosts, displacement);
    compute_rate(pool_, data, *problem_.gradients, displacement, false, rate);
    if (problem_.bodies) {
      answer_pressure(*problem_.bodies, pressure, problem_.particle_mass, work_.answers);
      add_body_rates(*problem_.bodies, work_.answers, rate);
    }
    passes_ += 2;
  }
  /// u = -J'p and r = b + J u for the present p.
  void refresh() {
    apply(work_.pressure, work_.displacement, work_.residual);
    start_residuals(work_.residual.data());
  }
  void start_residuals(const float* rate) {
    pool_.for_each_range(count_, kBlock,
                         [&](std::size_t begin, std::size_t end) { start_residual(begin, end, arrays_, rate); });
  }

  TaskPool& pool_;
  const ConstraintProblem& problem_;
  SolveWorkspace& work_;
  std::uint32_t& passes_;
  std::size_t count_;
  SolveArrays arrays_;
};

SolveReport iterate_conjugate_gradient(Solver& solver, const SolveSettings& settings, Totals state) {
  SolveReport report;
  float step = kFirstStep;
  double last_s_image = 0.0;
  for (int restarts = 0;;) {
    report.residual = solver.mean_error(state);
    if (report.residual < settings.tolerance && report.iterations >= settings.min_iterations) break;
    if (report.iterations >= settings.max_iterations) break;
    // Conjugate to the last actual move.
    const double beta = last_s_image > 0.0 ? -state.z_image / last_s_image : 0.0;
    const Totals direction = solver.direction(static_cast<float>(beta), step);
    if (!(direction.r_direction > 0.0)) {
      if (last_s_image == 0.0 || ++restarts > kRestarts) break;  // nothing left to gain
      last_s_image = 0.0;
      continue;
    }
    const Totals product = solver.multiply();
    if (!(product.s_image > 0.0)) break;
    const float exact = static_cast<float>(direction.r_direction / product.s_image);
    const float t = std::min(exact, std::max(1.0F, direction.longest));
    state = solver.advance(t, 1.0F / step);
    last_s_image = product.s_image / (static_cast<double>(step) * static_cast<double>(step));
    step = std::clamp(step * t, kSmallestStep, kLargestStep);
    ++report.iterations;
  }
  return report;
}

/// Sweeps until the error is below the tolerance; `sweep` makes one and returns what it leaves.
template <class Sweep>
SolveReport iterate_sweeps(const Solver& solver, const SolveSettings& settings, Totals state, Sweep&& sweep) {
  SolveReport report;
  for (;;) {
    report.residual = solver.mean_error(state);
    if (report.residual < settings.tolerance && report.iterations >= settings.min_iterations) break;
    if (report.iterations >= settings.max_iterations) break;
    state = sweep(static_cast<float>(settings.jacobi_damping));
    ++report.iterations;
  }
  return report;
}

SolveReport iterate(Solver& solver, const SolveSettings& settings, const Totals& first) {
  switch (settings.method) {
    case SolveMethod::kConjugateGradient:
      return iterate_conjugate_gradient(solver, settings, first);
    case SolveMethod::kJacobi:
      return iterate_sweeps(solver, settings, first, [&](float damping) { return solver.jacobi(damping); });
    case SolveMethod::kPaper:
      return iterate_sweeps(solver, settings, solver.judge_compression(),
                            [&](float damping) { return solver.clamped_jacobi(damping); });
  }
  return {};
}

}  // namespace

SolveReport solve_constraint(TaskPool& pool, const ConstraintProblem& problem, const SolveSettings& settings,
                             std::span<float> memory, SolveWorkspace& work, std::uint32_t& pair_passes) {
  const PairData& data = *problem.data;
  const std::size_t padded = data.ghosts ? extended_count(data.count, *data.ghosts) : padded_count(data.count);
  for (std::vector<float>* v : {&work.pressure, &work.start, &work.residual, &work.direction, &work.image})
    v->resize(padded, 0.0F);
  // The far dummy carries no pressure and does not move.
  for (std::size_t i = data.count; i < padded_count(data.count); ++i)
    work.pressure[i] = work.start[i] = work.residual[i] = work.direction[i] = work.image[i] = 0.0F;
  work.displacement.resize(padded);
  work.trial.resize(padded);
  Solver solver(pool, problem, work, pair_passes);
  const Totals first =
      solver.start(memory, settings.method == SolveMethod::kPaper ? 0.0F : static_cast<float>(settings.warm_start));
  SolveReport report = iterate(solver, settings, first);
  report.converged = report.residual < settings.tolerance;
  solver.remember(memory);
  return report;
}

}  // namespace pelagos
