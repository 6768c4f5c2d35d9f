// How the water is computed: solver, time step, governor.

#include <algorithm>
#include <cmath>

#include "scene.pb.h"
#include "validate_scene.hpp"

namespace pelagos {
namespace {

constexpr double kLargestTolerance = 0.05;  // fraction of the rest density

SolverKind read_kind(const FieldReader& solver) {
  switch (solver.read_enum("kind")) {
    case proto::v1::Solver::HYBRID:
      return SolverKind::kHybrid;
    case proto::v1::Solver::DFSPH:
      return SolverKind::kDfsph;
    case proto::v1::Solver::PBF:
      return SolverKind::kPbf;
    default:
      return SolverKind::kCorrected;
  }
}

PressureMethod read_method(const FieldReader& solver) {
  switch (solver.read_enum("method")) {
    case proto::v1::Solver::JACOBI:
      return PressureMethod::kJacobi;
    case proto::v1::Solver::PAPER:
      return PressureMethod::kPaper;
    default:
      return PressureMethod::kConjugateGradient;
  }
}

/// @param least  iterations that the scheme can do with
void read_constraint(const FieldReader& solver, const char* name, int least, ConstraintSettings& settings) {
  if (!solver.has(name)) return;
  const FieldReader reader = solver.child(name);
  reader.read("tolerance",
              {1e-6, kLargestTolerance, "", "a fraction of the rest density; single precision resolves no less"},
              settings.tolerance);
  const bool min_sound = reader.read("min_iterations", {static_cast<double>(least), 1000}, settings.min_iterations) ||
                         !reader.has("min_iterations");
  const bool max_sound =
      reader.read("max_iterations", {1, 1000}, settings.max_iterations) || !reader.has("max_iterations");
  if (min_sound && max_sound && settings.min_iterations > settings.max_iterations) {
    reader.fault(reader.has("min_iterations") ? "min_iterations" : "max_iterations",
                 "min_iterations " + std::to_string(settings.min_iterations) + " is above max_iterations " +
                     std::to_string(settings.max_iterations) + "; allowed: at most max_iterations");
  }
}

/// A setting that the chosen solver does not use is a mistake of whoever wrote it, not a wish to be ignored.
void refuse_unused(const FieldReader& entry, const SolverSettings& solver) {
  const auto refuse = [&](const char* name, bool used, const char* by) {
    if (entry.has(name) && !used)
      entry.fault(name, std::string("is used by ") + by + " only; allowed with the others: leave it out");
  };
  refuse("filter", solver.kind == SolverKind::kCorrected, "kind: CORRECTED");
  refuse("divergence", solver.kind != SolverKind::kPbf, "kinds CORRECTED, HYBRID and DFSPH");
  refuse("relaxation", solver.method != PressureMethod::kConjugateGradient, "methods JACOBI and PAPER");
  refuse("warm_start", solver.method != PressureMethod::kPaper, "methods CONJUGATE_GRADIENT and JACOBI");
}

/// Largest step that any setting may ask for, s: twice the default, where solves begin to fail.
double longest_step(const Basis& basis) { return basis.default_step ? 2.0 * *basis.default_step : 10.0; }

}  // namespace

SolverSettings validate_solver(const FieldReader& scene_reader) {
  if (!scene_reader.has("solver")) return {};
  const FieldReader entry = scene_reader.child("solver");
  SolverSettings solver = default_solver(read_kind(entry));
  solver.method = read_method(entry);
  const bool corrected = solver.kind == SolverKind::kCorrected;
  if (corrected && solver.method == PressureMethod::kPaper) {
    entry.fault("method",
                "PAPER goes with the paper's own schemes, not with CORRECTED; allowed there: CONJUGATE_GRADIENT, "
                "JACOBI (or kind: HYBRID, DFSPH or PBF)");
  }
  read_constraint(entry, "density", corrected ? 0 : 1, solver.density);  // corrected: repairs only what is compressed
  read_constraint(entry, "divergence", 1, solver.divergence);
  entry.read("relaxation", {0.01, 0.9, "", "0.5 is safe, 1 is known to fail"}, solver.relaxation);
  entry.read("warm_start", {0.0, 1.0, "", "0 starts cold"}, solver.warm_start);
  entry.read("filter", {0.0, 20.0}, solver.filter);
  refuse_unused(entry, solver);
  return solver;
}

TimeStepSettings validate_time_step(const FieldReader& scene_reader, const Basis& basis) {
  TimeStepSettings settings;
  const FieldReader entry = scene_reader.child("time_step");
  entry.read("cfl", {0.05, 1.0}, settings.cfl);
  entry.read("max_step", {1e-6, longest_step(basis), "s", "twice 0.07 sqrt(d/g), where solves begin to fail"},
             settings.max_step);
  if (basis.gravity && *basis.gravity == 0.0 && !entry.has("max_step")) {
    scene_reader.fault("gravity", "is 0, which leaves no time scale; needed then: time_step.max_step, above 0 to 10 s");
  }
  return settings;
}

GovernorSettings validate_governor(const FieldReader& scene_reader, const Basis& basis, const Scene& scene) {
  GovernorSettings governor;
  if (!scene_reader.has("governor")) return governor;
  const FieldReader entry = scene_reader.child("governor");
  governor.on = true;
  entry.read("frame_budget",
             {1e-4, scene.frame_interval, "s", "1 / frame_rate: with more the frame rate cannot be kept"},
             governor.frame_budget);
  const double own_tolerance = std::max(scene.solver.density.tolerance, scene.solver.divergence.tolerance);
  governor.largest_tolerance = std::max(governor.largest_tolerance, own_tolerance);
  entry.read("largest_tolerance",
             {own_tolerance, kLargestTolerance, "", "a fraction of the rest density, at least the solver's tolerances"},
             governor.largest_tolerance);
  const double own_step = scene.time_step.max_step > 0.0 ? scene.time_step.max_step : basis.default_step.value_or(1e-6);
  entry.read("largest_step",
             {own_step, longest_step(basis), "s", "at least the scene's max_step, at most 0.14 sqrt(d/g)"},
             governor.largest_step);
  return governor;
}

}  // namespace pelagos
