#include "renderer/sky.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scales/scales.hpp"

namespace pelagos {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kDegreesPerHour = 15.0;
constexpr double kStrength = 1.25;       // of the sun at its usual place
constexpr double kFogThickness = 120.0;  // m: of the layer that holds haze or fog

const Eigen::Vector3d kUsualSun = Eigen::Vector3d(-0.62, -0.48, 0.62).normalized();

/// How much longer the way through the air is than straight up (Kasten and Young 1989). @param elevation  degrees
double air_mass(double elevation) {
  const double e = std::max(elevation, 0.0);
  return 1.0 / (std::sin(e * kRad) + 0.50572 * std::pow(e + 6.07995, -1.6364));
}

/// What the air leaves of the sun's red, green and blue: optical depths of clear maritime air.
Eigen::Vector3d sun_through_air(double elevation) {
  const Eigen::Array3d depth(0.09, 0.15, 0.27);
  return (-depth * air_mass(elevation)).exp();
}

/// Linear between points.
template <std::size_t N>
double along(const std::array<std::array<double, 2>, N>& points, double x) {
  if (x <= points.front()[0]) return points.front()[1];
  for (std::size_t i = 1; i < N; ++i)
    if (x <= points[i][0])
      return std::lerp(points[i - 1][1], points[i][1], (x - points[i - 1][0]) / (points[i][0] - points[i - 1][0]));
  return points.back()[1];
}

/// Twilight as an adapted eye takes it: the horizon fades at 12 degrees below, stars stand at 6.
double daylight_of(double elevation) {
  return along<6>({{{-18.0, 0.05}, {-12.0, 0.07}, {-6.0, 0.17}, {0.0, 0.42}, {6.0, 0.75}, {15.0, 1.0}}}, elevation);
}

double wrapped(double degrees) { return std::remainder(degrees, 360.0); }

}  // namespace

SunPlace sun_place(double utc, double latitude_deg, double longitude_deg) {
  const double days = utc / 86'400.0 - 10'957.5;  // since noon of the first of January 2000
  const double mean_longitude = wrapped(280.460 + 0.9856474 * days);
  const double anomaly = wrapped(357.528 + 0.9856003 * days) * kRad;
  const double ecliptic = (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2.0 * anomaly)) * kRad;
  const double tilt = (23.439 - 4e-7 * days) * kRad;
  const double ascension = std::atan2(std::cos(tilt) * std::sin(ecliptic), std::cos(ecliptic)) / kRad;
  const double declination = std::asin(std::sin(tilt) * std::sin(ecliptic));
  const double sidereal = std::fmod(18.697374558 + 24.06570982441908 * days, 24.0) * kDegreesPerHour;
  const double hour_angle = wrapped(sidereal + longitude_deg - ascension) * kRad;
  const double latitude = latitude_deg * kRad;
  const double up =
      std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north =
      std::cos(latitude) * std::sin(declination) - std::sin(latitude) * std::cos(declination) * std::cos(hour_angle);
  return {std::asin(std::clamp(up, -1.0, 1.0)), std::atan2(east, north)};
}

bool SkyMoment::looks_like(const SkyMoment& other) const {
  const double turn = std::cos(0.2 * kRad);
  return sun.dot(other.sun) > turn && clouds == other.clouds && visibility == other.visibility;
}

SkyMoment sky_at(const Weather& weather, const GeodeticOrigin& origin, double time) {
  SkyMoment sky;
  sky.sun = kUsualSun;
  if (weather.utc) {
    const SunPlace place = sun_place(*weather.utc + time, origin.latitude_deg, origin.longitude_deg);
    sky.sun = {std::cos(place.elevation) * std::sin(place.azimuth), std::cos(place.elevation) * std::cos(place.azimuth),
               std::sin(place.elevation)};
  }
  const double elevation = std::asin(std::clamp(sky.sun.z(), -1.0, 1.0)) / kRad;
  const Eigen::Vector3d left = sun_through_air(elevation), usual = sun_through_air(std::asin(kUsualSun.z()) / kRad);
  sky.clouds = weather.cloud_oktas / 8.0;
  sky.visibility = weather.visibility;
  const double risen = std::clamp((elevation + 0.8) / 1.6, 0.0, 1.0);
  const double through_clouds = 1.0 - 0.97 * std::clamp((sky.clouds - 0.6) / 0.4, 0.0, 1.0);
  const double through_fog = std::exp(-3.0 * kFogThickness / weather.visibility * air_mass(elevation));
  const double usual_fog = std::exp(-3.0 * kFogThickness / Weather().visibility * air_mass(38.0));
  sky.sun_strength = kStrength * risen * through_clouds * left.y() / usual.y() * std::min(through_fog / usual_fog, 1.0);
  sky.sun_colour = (left.array() / left.y()) / (usual.array() / usual.y());
  sky.daylight = daylight_of(elevation);
  return sky;
}

}  // namespace pelagos
