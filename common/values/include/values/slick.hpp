#pragma once

#include <cstdint>

namespace pelagos {

/// Bonn Agreement Oil Appearance Code: how a film of a thickness looks from the air.
enum class OilAppearance : std::uint8_t {
  kNone,               ///< below 0.04 um: not to be seen
  kSheen,              ///< code 1, 0.04 to 0.3 um: silvery or grey
  kRainbow,            ///< code 2, 0.3 to 5 um
  kMetallic,           ///< code 3, 5 to 50 um
  kDiscontinuousTrue,  ///< code 4, 50 to 200 um: the oil's colour in places
  kContinuousTrue,     ///< code 5, above 200 um: the oil's own colour
};

/// Radius of the disc that stands for an element, by that of the bell its oil lies under: a lone element's oil spread
/// evenly over the disc has Fay's area.
inline constexpr double kDiscPerSize = 0.6312;

/// One element for drawing: a disc on the water. Discs of a slick overlap; `thickness` is that of the film there, all
/// elements together, so a picture takes the largest or a mean of the overlapping discs, not their sum.
struct SlickDisc {
  float x, y, z;    ///< m, world; z is the water's surface
  float radius;     ///< m
  float thickness;  ///< m, of the film at the centre, emulsion water included
  float mass;       ///< kg of oil
  float water;      ///< volume share of water in the emulsion
  OilAppearance appearance;
  bool contained;
};

}  // namespace pelagos
