#include "solver_names.hpp"

namespace pelagos {

namespace {

struct Choice {
  const char* name;
  SolverKind kind;
  PressureMethod method;
};
constexpr Choice kChoices[] = {
    {"hybrid", SolverKind::kHybrid, PressureMethod::kConjugateGradient},
    {"hybrid-jacobi", SolverKind::kHybrid, PressureMethod::kJacobi},
    {"hybrid-paper", SolverKind::kHybrid, PressureMethod::kPaper},
    {"dfsph", SolverKind::kDfsph, PressureMethod::kConjugateGradient},
    {"dfsph-jacobi", SolverKind::kDfsph, PressureMethod::kJacobi},
    {"dfsph-paper", SolverKind::kDfsph, PressureMethod::kPaper},
    {"pbf", SolverKind::kPbf, PressureMethod::kConjugateGradient},
    {"pbf-jacobi", SolverKind::kPbf, PressureMethod::kJacobi},
    {"pbf-paper", SolverKind::kPbf, PressureMethod::kPaper},
    {"corrected", SolverKind::kCorrected, PressureMethod::kConjugateGradient},
    {"corrected-jacobi", SolverKind::kCorrected, PressureMethod::kJacobi},
};

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Choice& choice : kChoices) all.emplace_back(choice.name);
    return all;
  }();
  return names;
}

bool choose_solver(std::string_view name, SolverSettings& solver) {
  for (const Choice& choice : kChoices) {
    if (name != choice.name) continue;
    if (solver.kind != choice.kind) solver = default_solver(choice.kind);
    solver.method = choice.method;
    return true;
  }
  return false;
}

std::string solver_name(const SolverSettings& solver) {
  for (const Choice& choice : kChoices)
    if (choice.kind == solver.kind && choice.method == solver.method) return choice.name;
  return "unknown";
}

}  // namespace pelagos
