#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/particles.hpp"
#include "physics/task_pool.hpp"
#include "values/wind.hpp"

namespace pelagos {

/// What the law needs to know of the water it blows over.
struct GustSite {
  double spacing = 0.05;         ///< particle spacing d, m, > 0
  double gravity = 9.81;         ///< m/s^2, >= 0; without gravity the law has no time scale and the wind no push
  double rest_density = 1000.0;  ///< kg/m^3, > 0
  double water_level = 0.0;      ///< m, world: mean level, where the disturbance is sampled
  std::uint64_t seed = 1;        ///< of the disturbance
};

/// The wind law `gust`: an acceleration of the water that does not depend on the time step.
///   a = beta (rho_air / rho0) v f(depth) / t_ref ,   t_ref = 0.07 sqrt(d / g) ,   f = exp(-depth / (4.614 d))
///   v = g(t) [U + A noise(s)] ,   s = x / l - integral of U / l dt   ( = (x - U t) / l in a constant wind)
/// with g(t) the pulse (1 in its width, else 0), rho_air = 1.293 kg/m^3, and three independent noises (Perlin 2002) for
/// the components, offset by the seed. After Li et al.'s stochastic fluctuating wind (paper eq. 31 to 35), with these
/// differences: the paper adds a velocity every step, so that its push grows as the step shrinks; its profile rises
/// from the bottom, here it falls from the surface; its disturbance is white noise in time, here it is carried by the
/// mean wind (frozen turbulence). f keeps the mean push of the paper's own scene; gust_wind.cpp derives it.
///
/// The disturbance has a standard deviation of about 0.27 A a component, and repeats after 256 l.
class GustWind {
 public:
  /// @param wind  blows at once
  /// @param time  s, simulation time; the disturbance starts unshifted at this time
  GustWind(const GustSite& site, const WindSettings& wind, double time = 0.0);

  /// From the wind that blows at `time` linearly to `wind` over `ramp_seconds` (<= 0: at once): velocity, amplitude,
  /// length, control factor and the value of the pulse. Velocity and disturbance stay continuous, also when a ramp is
  /// replaced before its end. Times must not decrease from call to call.
  void set(const WindSettings& wind, double time, double ramp_seconds);

  /// The settings as they are at `time`, mid-ramp values included.
  [[nodiscard]] WindSettings settings_at(double time) const;

  /// Velocity of the air, m/s: what an anemometer at `position` (m, world) reads.
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& position, double time) const;

  /// Adds the push of the wind to `acceleration` (m/s^2) of the first `count` particles.
  /// The air is sampled at the mean level on a horizontal grid of 2 d and interpolated linearly; depth is counted from
  /// the water's surface above the particle, which is the highest particle of each grid cell plus d/2 (flying drops
  /// left out), interpolated alike. Each particle writes only its own entry: the same bits for any number of threads.
  /// Eddies shorter than about 10 d are smoothed (root mean square error of the disturbance 2 % at l = 10 d).
  /// Particles with positions that are not finite are left alone.
  void add_acceleration(TaskPool& pool, std::span<const Float4> position, std::size_t count, double time,
                        std::span<Float4> acceleration);

  /// Depth at which the push has fallen to 1/e of that at the surface, in spacings.
  static constexpr double kDecaySpacings = 4.614;
  static constexpr double kAirDensity = 1.293;  ///< kg/m^3 (paper eq. 33)

 private:
  struct Blend {
    double part;   ///< of the new wind, 0..1
    double pulse;  ///< 0..1
    WindSettings wind;
  };
  [[nodiscard]] Blend blend_at(double time) const;
  /// Integral of U / l from the start of the ramp to `time`, added to what was carried before.
  [[nodiscard]] Eigen::Vector3d carried_at(double time) const;
  [[nodiscard]] Eigen::Vector3d disturbance(const Eigen::Vector3d& position, double length,
                                            const Eigen::Vector3d& carried) const;

  GustSite site_;
  std::array<Eigen::Vector3d, 3> offset_;  ///< of the noise of each component
  WindSettings from_, to_;
  double from_pulse_ = 1.0;  ///< value of the pulse when the ramp began
  double ramp_start_ = 0.0, ramp_seconds_ = 0.0;
  Eigen::Vector3d carried_ = Eigen::Vector3d::Zero();  ///< at the ramp's start, in eddy lengths

  std::vector<float> height_;   ///< highest particle of each cell; scratch
  std::vector<Float4> column_;  ///< air velocity and, in w, water surface of each cell; scratch
};

}  // namespace pelagos
