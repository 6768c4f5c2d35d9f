#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>

namespace pelagos {

/// Periodic pulse of the wind (paper eq. 35), in seconds: the wind blows for `width` at the start of each `period`.
struct WindPulse {
  double period = 10.0;  ///< s, > 0
  double width = 10.0;   ///< s, 0 < width <= period
};

/// The law `gust`: an acceleration that does not depend on the time step.
///   a = beta (rho_air / rho_water) v_wind f(depth) / t_ref,   t_ref = 0.07 sqrt(d / g)
///   v_wind = mean + amplitude * noise((x - mean t) / length)
struct WindSettings {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, mean wind at 10 m, the direction the air moves TOWARDS
  double amplitude = 0.0;                              ///< m/s, of the Perlin disturbance per component, >= 0
  double length = 10.0;                                ///< m, size of the disturbance's eddies, > 0
  double beta = 1.5;                                   ///< control factor of the paper, >= 0
  std::optional<WindPulse> pulse;
};

/// Degrees clockwise from north that the wind blows FROM, and the horizontal speed; and back.
[[nodiscard]] inline double wind_from_deg(const Eigen::Vector3d& velocity) {
  constexpr double kDegrees = 57.29577951308232;
  const double degrees = std::atan2(-velocity.x(), -velocity.y()) * kDegrees;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}
[[nodiscard]] inline Eigen::Vector3d wind_velocity(double speed, double from_deg) {
  constexpr double kRadians = 0.017453292519943295;
  return {-speed * std::sin(from_deg * kRadians), -speed * std::cos(from_deg * kRadians), 0.0};
}

}  // namespace pelagos
