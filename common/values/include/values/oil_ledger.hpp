#pragma once

#include "values/oil_mass.hpp"

namespace pelagos {

/// Where the oil is, in milligrams of oil (the water in emulsions is no oil). `released` is booked where oil enters;
/// `afloat` and `contained` are the elements' own masses added up, not booked, so that balance() == 0 proves that no
/// step lost or made a milligram.
struct OilLedger {
  Milligrams released = 0;
  Milligrams afloat = 0;     ///< in the slick, free
  Milligrams contained = 0;  ///< in the slick, held by booms
  Milligrams submerged = 0;  ///< with the particle phase
  Milligrams recovered = 0;  ///< by skimmers
  Milligrams evaporated = 0;
  Milligrams left_patch = 0;  ///< drifted out of the simulated patch

  /// What is missing, mg: 0.
  [[nodiscard]] Milligrams balance() const {
    return released - (afloat + contained + submerged + recovered + evaporated + left_patch);
  }
  bool operator==(const OilLedger&) const = default;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("released", self.released);
    visit("afloat", self.afloat);
    visit("contained", self.contained);
    visit("submerged", self.submerged);
    visit("recovered", self.recovered);
    visit("evaporated", self.evaporated);
    visit("left_patch", self.left_patch);
  }
};

}  // namespace pelagos
