#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/particles.hpp"
#include "physics/surface_grid.hpp"
#include "physics/task_pool.hpp"
#include "scales/scales.hpp"
#include "wind/air.hpp"

namespace pelagos {

/// What the laws need to know of the water that the wind blows over.
struct WindSurroundings {
  AirSurroundings air;
  double spacing = 0.05;              ///< particle spacing d, m, > 0
  double gravity = kStandardGravity;  ///< m/s^2, >= 0; without gravity the law gust has no time scale and no push
  double rest_density = kUsualWaterDensity;  ///< kg/m^3, > 0
};

/// The wind and its push on the water, by one of three laws.
///
/// WindLaw::kGust, an acceleration that does not depend on the time step:
///   a = beta (rho_air / rho0) v10 f(depth) / t_ref ,   t_ref = 0.07 sqrt(d / g) ,   f = exp(-depth / (4.614 d))
/// with rho_air = 1.293 kg/m^3. After the paper's eq. 33 and 34, with these differences: the paper adds a velocity
/// every step, so that its push grows as the step shrinks; its profile rises from the bottom, here it falls from the
/// surface. f keeps the mean push of the paper's own scene; surface_push.cpp derives it.
///
/// WindLaw::kStress, the drag of a wind on the sea:
///   a = rho_air Cd |v10| v10 f(depth) / (rho0 D) ,   f = exp(-depth / D) ,   D = d ,   Cd of Large and Pond 1981
/// so that each square metre takes up the momentum rho_air Cd |v10| v10 a second, most of it in the upper two layers.
/// The water's own velocity is not subtracted: it is a few per cent of the wind's.
///
/// WindLaw::kPaper, eq. 31 to 35 as printed, for the paper's figures: every step, whatever its length,
///   v += beta (rho_air / rho0) v_ref ln(z / z0) / ln(10 m / z0) ,   v_ref = U + A noise(x / l)
/// with z from the patch's floor, a new noise every step, and the logarithm negative below z0. Particles at or under
/// the floor take none.
class Wind {
 public:
  Wind(const WindSurroundings& around, const WindSettings& settings, double time = 0.0)
      : around_(around), air_(around.air, settings, time) {}
  /// Goes on with air that blew before.
  Wind(const WindSurroundings& around, const Air& air) : around_(around), air_(air) {}

  /// See Air::set.
  void set(const WindSettings& settings, double time, double ramp_seconds) { air_.set(settings, time, ramp_seconds); }

  void follow(const PatchFrame& frame) { air_.follow(frame); }  ///< see Air::follow

  [[nodiscard]] const Air& air() const { return air_; }

  /// The push of the wind on the first `count` particles, once a step: an acceleration (m/s^2) that is added, or a
  /// velocity (m/s) with the paper's law.
  ///
  /// The laws gust and stress sample the air at the centres of the surface's grid (2 d) and interpolate linearly; depth
  /// is counted from that surface above the particle, interpolated alike (a dry cell takes the mean of the wet ones
  /// around it, or the mean level). The paper's law does not look at the surface. Eddies shorter than about 10 d are
  /// smoothed (root mean square error of the disturbance 2 % at l = 10 d). Each particle writes only its own entry: the
  /// same bits for any number of threads. Particles with positions that are not finite are left alone.
  /// @param surface  of the same particles; null is allowed where asks_surface(time) is false
  void act(TaskPool& pool, const SurfaceGrid* surface, std::span<const Float4> position, std::size_t count, double time,
           std::span<Float4> acceleration, std::span<Float4> velocity);

  /// Whether `act` at that time looks at the water's surface.
  [[nodiscard]] bool asks_surface(double time) const;

  /// Depth at which the push of the law gust has fallen to 1/e of that at the surface, in spacings.
  static constexpr double kDecaySpacings = 4.614;

 private:
  void push_surface(TaskPool& pool, const SurfaceGrid& surface, std::span<const Float4> position,
                    const Air::Moment& moment, std::span<Float4> acceleration);
  void push_as_printed(TaskPool& pool, std::span<const Float4> position, const Air::Moment& moment,
                       std::span<Float4> velocity) const;

  WindSurroundings around_;
  Air air_;
  std::vector<Float4> column_;  ///< push at the surface and, in w, the water's surface of each cell; scratch
};

}  // namespace pelagos
