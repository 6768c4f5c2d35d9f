#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "values/oil_mass.hpp"
#include "values/slick.hpp"

namespace pelagos {

/// One surface element ("spillet"): some oil with a place and a size. Its oil lies under a bell of radius `size`
/// around the place; film.hpp says how the bells of a slick add up to its film.
struct SlickElement {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world
  double size = 0.0;                                   ///< m, > 0
  Milligrams mass = 0;                                 ///< of oil, without the water in an emulsion; > 0
  double evaporated = 0.0;                             ///< share of the fresh oil that has evaporated, 0..1
  double evaporation_rest = 0.0;                       ///< mg evaporated that did not fill a milligram yet, 0..1
  double water = 0.0;                                  ///< volume share of water in the emulsion, 0..1
  double age = 0.0;                                    ///< s, since the release; mean by mass where elements merged
  double film = 0.0;       ///< m, thickness of the slick at the place, emulsion water included
  double height = 0.0;     ///< m, world, of the water's surface at the place, where it was last known
  bool contained = false;  ///< held by a boom

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("position", self.position);
    visit("size", self.size);
    visit("mass", self.mass);
    visit("evaporated", self.evaporated);
    visit("evaporation_rest", self.evaporation_rest);
    visit("water", self.water);
    visit("age", self.age);
    visit("film", self.film);
    visit("height", self.height);
    visit("contained", self.contained);
  }
};

/// Radius of the disc that stands for an element.
[[nodiscard]] inline double disc_radius(const SlickElement& element) { return kDiscPerSize * element.size; }

/// Volume of oil and emulsion water, m^3.
[[nodiscard]] inline double film_volume(const SlickElement& element, double oil_density) {
  return to_kilograms(element.mass) / oil_density / (1.0 - element.water);
}

/// Takes `part` (0 < part < element.mass) out of the element: the same oil at the same place, smaller by the mass.
[[nodiscard]] SlickElement split_off(SlickElement& element, Milligrams part);

/// Pours `other` into `element`. Mass exactly; centre of mass, second moment of the film, evaporated share, water and
/// age as means, so that the slick neither gains nor loses extent.
void pour_in(SlickElement& element, const SlickElement& other);

}  // namespace pelagos
