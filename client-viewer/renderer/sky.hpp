#pragma once

#include <Eigen/Core>
#include <optional>

#include "values/scene.hpp"

namespace pelagos {

/// What the sky and the air are like.
struct Weather {
  /// s since 1970 at the simulation's time 0; nothing: the sun stands still, at 38 degrees
  std::optional<double> utc = std::nullopt;
  double cloud_oktas = 3.0;      ///< 0 clear .. 8 overcast
  double visibility = 23'000.0;  ///< m: here a dark object has 5 % of its contrast left (Koschmieder)
};

/// Where the sun stands, rad.
struct SunPlace {
  double elevation = 0.0;
  double azimuth = 0.0;  ///< clockwise from north
};
/// By the low-precision formulas of the Astronomical Almanac: within 0.01 degrees from 1950 to 2050, without
/// refraction.
/// @param utc  s since 1970   @param latitude_deg, longitude_deg  degrees, north and east positive
[[nodiscard]] SunPlace sun_place(double utc, double latitude_deg, double longitude_deg);

/// The light at one instant, as the shaders take it.
struct SkyMoment {
  Eigen::Vector3d sun = Eigen::Vector3d::UnitZ();        ///< unit, towards the sun, also below the horizon
  double sun_strength = 0.0;                             ///< of its direct light; 1.25 at 38 degrees in a clear sky
  Eigen::Vector3d sun_colour = Eigen::Vector3d::Ones();  ///< of its direct light; the green part is 1
  double daylight = 1.0;    ///< 1 by day .. 0.05 at night: what the eye makes of it, not the illuminance
  double clouds = 0.0;      ///< 0..1, oktas / 8
  double visibility = 0.0;  ///< m

  /// Whether a picture of the sky made for the other one may still be shown.
  [[nodiscard]] bool looks_like(const SkyMoment& other) const;
};
/// @param time  s, simulation time
[[nodiscard]] SkyMoment sky_at(const Weather& weather, const GeodeticOrigin& origin, double time);

}  // namespace pelagos
