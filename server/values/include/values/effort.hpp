#pragma once

namespace pelagos {

/// What a step may cost: how long it may be and how exactly its constraints are solved.
struct Effort {
  double max_step = 0.0;              ///< s
  double density_tolerance = 0.0;     ///< fraction of the rest density
  double divergence_tolerance = 0.0;  ///< fraction of the rest density
  bool operator==(const Effort&) const = default;
};

}  // namespace pelagos
