#include "convergence_watch.hpp"

#include <cstdio>

namespace pelagos {

void ConvergenceWatch::Constraint::add(const SolveReport& solve, double tolerance_now) {
  if (solve.converged) return;
  ++steps;
  if (residual > 0.0 && !(solve.residual > residual)) return;
  residual = solve.residual;
  tolerance = tolerance_now;
  iterations = solve.iterations;
}

void ConvergenceWatch::add(const StepReport& report, const Effort& effort) {
  ++steps_;
  density_.add(report.density, effort.density_tolerance);
  divergence_.add(report.divergence, effort.divergence_tolerance);
}

std::string ConvergenceWatch::describe(const char* name, const Constraint& constraint) const {
  if (constraint.steps == 0) return "";
  char text[300];
  std::snprintf(text, sizeof text,
                "the %s constraint missed its tolerance in %llu of %llu steps: residual up to %.2g against %.2g after "
                "%d iterations; raise solver.%s.max_iterations or .tolerance, or lower time_step.max_step",
                name, static_cast<unsigned long long>(constraint.steps), static_cast<unsigned long long>(steps_),
                constraint.residual, constraint.tolerance, constraint.iterations, name);
  return text;
}

std::string ConvergenceWatch::take() {
  std::string text = describe("density", density_);
  const std::string more = describe("divergence", divergence_);
  if (!text.empty() && !more.empty()) text += "; ";
  *this = {};
  return text + more;
}

}  // namespace pelagos
