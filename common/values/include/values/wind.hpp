#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>

#include "scales/angles.hpp"

namespace pelagos {

/// How the wind pushes the water; server/wind has the formulas.
enum class WindLaw {
  kGust,    ///< the paper's strong push as an acceleration that does not depend on the time step
  kStress,  ///< the drag of a real wind on the sea's surface, far weaker
  kPaper,   ///< the paper's equations as printed: a velocity added every step; for its figures
};

/// Periodic pulse of the wind (paper eq. 35): it blows for `width` at the start of each `period`.
struct WindPulse {
  double period = 10.0;  ///< s, > 0; with the law kPaper steps
  double width = 10.0;   ///< s, 0 < width <= period; with the law kPaper steps, and any width > 0

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("period", self.period);
    visit("width", self.width);
  }
};

/// The air's velocity at 10 m is g(t) [mean + amplitude noise((x - mean t) / length)], with the pulse g.
struct WindSettings {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, mean wind at 10 m, the direction the air moves TOWARDS
  double amplitude = 0.0;                              ///< m/s, of the Perlin disturbance per component, >= 0
  double length = 10.0;                                ///< m, size of the disturbance's eddies, > 0
  double beta = 1.5;                                   ///< control factor of the paper, >= 0; not used by kStress
  std::optional<WindPulse> pulse;
  WindLaw law = WindLaw::kGust;
  double roughness = 2e-4;  ///< m, z0 of the log profile, > 0, < 10

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("velocity", self.velocity);
    visit("amplitude", self.amplitude);
    visit("length", self.length);
    visit("beta", self.beta);
    visit("pulse", self.pulse);
    visit("law", self.law);
    visit("roughness", self.roughness);
  }
};

/// Roughness that a wind has where nothing else is said: a smooth open sea, or as the paper's figures need it.
[[nodiscard]] inline double default_roughness(WindLaw law) { return law == WindLaw::kPaper ? 0.01 : 2e-4; }

/// Whether the pulse is as long as its period or longer, so that the wind never stops.
[[nodiscard]] inline bool never_closes(const WindPulse& pulse) { return pulse.width >= pulse.period; }

/// Degrees clockwise from north that the wind blows FROM, and the horizontal speed; and back.
[[nodiscard]] inline double wind_from_deg(const Eigen::Vector3d& velocity) {
  const double degrees = std::atan2(-velocity.x(), -velocity.y()) * kDegreesPerRadian;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}
[[nodiscard]] inline Eigen::Vector3d wind_velocity(double speed, double from_deg) {
  return {-speed * std::sin(from_deg * kRadiansPerDegree), -speed * std::cos(from_deg * kRadiansPerDegree), 0.0};
}

}  // namespace pelagos
