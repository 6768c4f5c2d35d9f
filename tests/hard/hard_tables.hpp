#pragma once

#include <string>
#include <vector>

namespace pelagos::hard {

/// Rows of text under column names, written as CSV and as a Markdown table.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  void add(std::vector<std::string> row);
  /// folder/name.csv and folder/name.md; throws std::runtime_error where they cannot be written.
  void write(const std::string& folder, const std::string& name) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

// The long hard cases, for the solvers named. Each returns its table and counts into `failures` what did not pass.

/// Those of the sweep: every scheme, Jacobi and the literal variants too.
inline const std::vector<std::string> kSweepSolvers = {"hybrid",        "dfsph",        "pbf",         "corrected",
                                                       "hybrid-jacobi", "hybrid-paper", "dfsph-paper", "pbf-paper"};

/// Solver by step factor (units of sqrt(d/g)) and by CFL number, up to break-up: a small dam break for 0.8 s.
[[nodiscard]] Table sweep_steps(const std::vector<std::string>& solvers, int& failures);
/// Still water 15, 30 and 60 layers deep at a tolerance of 1e-4: iterations and what moves.
[[nodiscard]] Table deep_water(const std::vector<std::string>& solvers, int& failures);
/// Still water and sloshing over so many steps.
[[nodiscard]] Table long_runs(const std::vector<std::string>& solvers, int steps, int& failures);
/// Oil of 0.99 and 0.1 times the water's density on a breaking dam, over so many steps.
[[nodiscard]] Table oil_runs(const std::vector<std::string>& solvers, int steps, int& failures);
/// Thousands of particles in one place: memory of the neighbour list and time of a step.
[[nodiscard]] Table crowds(int& failures);

}  // namespace pelagos::hard
