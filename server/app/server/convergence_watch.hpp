#pragma once

#include <cstdint>
#include <string>

#include "physics/step_report.hpp"
#include "values/effort.hpp"

namespace pelagos {

/// Collects steps whose constraints met their bound of iterations, for one line of warning now and then.
class ConvergenceWatch {
 public:
  /// @param effort  whose tolerances the step was solved to
  void add(const StepReport& report, const Effort& effort);

  /// What was not reached since the last call, and what to change; empty if everything was.
  [[nodiscard]] std::string take();

 private:
  struct Constraint {
    std::uint64_t steps = 0;
    double residual = 0.0, tolerance = 0.0;  ///< of the worst step
    int iterations = 0;
    void add(const SolveReport& solve, double tolerance_now);
  };
  [[nodiscard]] std::string describe(const char* name, const Constraint& constraint) const;

  std::uint64_t steps_ = 0;
  Constraint density_, divergence_;
};

}  // namespace pelagos
