#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "text/refusal.hpp"
#include "values/oil_mass.hpp"

namespace pelagos {

/// A moored boom: a floating barrier along a line, always at the surface.
///
/// Oil that would cross is held on its side and may slide along; it piles up (see SlickLayer). Below the critical speed
/// of the water across the boom nothing leaks. Above it drops are torn off the oil's head wave and pass under the boom
/// (entrainment failure; Wicks 1969; booms fail at about 0.7 knots of current across them, US Navy Ship Salvage Manual
/// vol. 6). How much is our closure, not a published fit: per metre of boom
///   q = entrainment h (U - U_c)   m^2/s      h thickness at the boom, U speed of the water across the boom
/// that is, the head wave is swept under as fast as the water exceeds the critical speed. Oil deeper than the skirt
/// drains at once (drainage failure).
struct Boom {
  std::vector<Eigen::Vector2d> line;  ///< m, world; 2 to 1000 points, finite, neighbours at least 0.1 m apart.
                                      ///< First = last point: a ring, and all oil inside counts as contained
  double draft = 0.5;                 ///< m, depth of the skirt, > 0
  double critical_speed = 0.36;       ///< m/s, U_c, > 0 (0.7 knots)
  double entrainment = 1.0;           ///< 0 (never leaks by entrainment) to 10

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("line", self.line);
    visit("draft", self.draft);
    visit("critical_speed", self.critical_speed);
    visit("entrainment", self.entrainment);
  }
};

/// A skimmer takes the oil under its disc, by the share of every element that lies there, at most at its nominal rate.
/// It takes emulsion as it is; the water in it counts against the rate and is not oil. Free water is not modelled.
struct Skimmer {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world, finite
  double radius = 2.0;                                 ///< m, > 0
  double rate = 20.0;                                  ///< m^3/h, >= 0: 0 is switched off

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("position", self.position);
    visit("radius", self.radius);
    visit("rate", self.rate);
  }
};

struct SkimmerReport {
  Milligrams recovered = 0;     ///< oil, since the skimmer was placed
  double emulsion_water = 0.0;  ///< m^3, recovered with it
  double present_rate = 0.0;    ///< m^3/h of oil and emulsion, in the last step
  bool dry = false;             ///< in the last step it was on and found less than a hundredth of what it can take

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("recovered", self.recovered);
    visit("emulsion_water", self.emulsion_water);
    visit("present_rate", self.present_rate);
    visit("dry", self.dry);
  }
};

/// What is wrong with it, naming field, value and what is allowed; empty if nothing is.
[[nodiscard]] std::optional<Refusal> find_fault(const Boom& boom);
[[nodiscard]] std::optional<Refusal> find_fault(const Skimmer& skimmer);

}  // namespace pelagos
