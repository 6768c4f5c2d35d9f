#pragma once

#include <string>

#include "harness.hpp"
#include "measures.hpp"

namespace pelagos::validation {

/// A column of water in the corner of a tank that is a thin slice: mirrors below and at both ends, periodic across.
/// Frictionless and without a gate.
struct DamBreak {
  double height = 2, length = 1, tank = 10;  ///< m
  int layers = 40;                           ///< spacings in the height
  static constexpr int kSlice = 4;           ///< spacings across

  [[nodiscard]] double spacing() const { return height / layers; }
};

[[nodiscard]] WaterRun start_dam_break(int threads, const DamBreak& dam, const SolverChoice& solver);

/// Path of a file of the experiments.
[[nodiscard]] std::string data_file(const std::string& name);

}  // namespace pelagos::validation
