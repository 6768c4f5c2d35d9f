#pragma once

namespace pelagos {

/// What a step may cost: how long it may be and how exactly its constraints are solved.
struct Effort {
  double max_step = 0.0;              ///< s
  double density_tolerance = 0.0;     ///< fraction of the rest density
  double divergence_tolerance = 0.0;  ///< fraction of the rest density
  bool operator==(const Effort&) const = default;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("max_step", self.max_step);
    visit("density_tolerance", self.density_tolerance);
    visit("divergence_tolerance", self.divergence_tolerance);
  }
};

}  // namespace pelagos
