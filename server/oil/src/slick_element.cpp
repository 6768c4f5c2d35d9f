#include "oil/slick_element.hpp"

#include <algorithm>
#include <cmath>

#include "film.hpp"

namespace pelagos {

SlickElement split_off(SlickElement& element, Milligrams part) {
  SlickElement piece = element;
  piece.mass = part;
  piece.evaporation_rest = 0.0;
  piece.size *= std::sqrt(static_cast<double>(part) / static_cast<double>(element.mass));
  element.mass -= part;
  return piece;
}

void pour_in(SlickElement& element, const SlickElement& other) {
  const double a = static_cast<double>(element.mass), b = static_cast<double>(other.mass);
  const double wa = a / (a + b), wb = b / (a + b);
  const Eigen::Vector2d apart = element.position - other.position;
  // Second moment about the common centre: of the bells, and of their centres.
  const double moment =
      wa * element.size * element.size + wb * other.size * other.size + wa * wb * apart.squaredNorm() / kBellMoment;
  const double fresh_a = a / std::max(1.0 - element.evaporated, 1e-9),
               fresh_b = b / std::max(1.0 - other.evaporated, 1e-9);
  const double wet_a = a / (1.0 - element.water), wet_b = b / (1.0 - other.water);
  element.position = wa * element.position + wb * other.position;
  element.size = std::sqrt(moment);
  element.evaporated = std::max(0.0, 1.0 - (a + b) / (fresh_a + fresh_b));
  element.water = (wet_a * element.water + wet_b * other.water) / (wet_a + wet_b);
  element.age = wa * element.age + wb * other.age;
  element.film = wa * element.film + wb * other.film;
  element.height = wa * element.height + wb * other.height;
  element.evaporation_rest += other.evaporation_rest;
  element.contained = element.contained || other.contained;
  element.mass += other.mass;
}

}  // namespace pelagos
