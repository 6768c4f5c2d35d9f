#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "waves/dispersion.hpp"

namespace pelagos {

/// One component at one instant, as the batches below and the viewer's shaders read it.
///   theta = 2 pi (phase + turns . (x - anchor)) ,   elevation = amplitude cos(theta)
struct MomentWave {
  float amplitude = 0;              ///< m, the blend's weight included
  float amplitude_rate = 0;         ///< m/s, how fast a blend changes it
  float along_x = 0, along_y = 0;   ///< unit, the way the crests run
  float turns_x = 0, turns_y = 0;   ///< 1/m, wave number over 2 pi times `along`
  float phase = 0;                  ///< turns, -1/2 to 1/2, at the anchor
  float wavenumber = 0, omega = 0;  ///< rad/m, rad/s
  float echo = 0;                   ///< e^(-2 k h), 0 where the bottom is not felt
  float bed = 1;                    ///< 1 / (1 - e^(-2 k h))
  float unused = 0;
};
static_assert(sizeof(MomentWave) == 48);  // three vectors of four floats in a shader

/// A wave field at one instant: what many places have in common. Places are metres from the anchor in single
/// precision; the phases at the anchor were reduced in double precision. So the error of an elevation is 1e-6 of the
/// waves' height near the anchor, and grows to 1e-4 of it at 1 km for waves of 6 m length, less for longer ones.
struct WaveMoment {
  double time = 0.0;                                 ///< s
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< m, world
  double level = 0.0;                                ///< m, world z of the mean level
  double depth = kInfiniteDepth;                     ///< m, below the mean level
  std::vector<MomentWave> waves;
};

/// The surface by linear (Airy) theory, arrays of one length.
struct WaveSurfaceArrays {
  std::span<float> elevation;         ///< m above the mean level
  std::span<float> slope_x, slope_y;  ///< d elevation / dx, / dy
  std::span<float> rate;              ///< d elevation / dt, m/s, a blend's part included
};

/// Evaluates the surface at (x[i], y[i]), m from the anchor. Each place's result depends on that place alone: the same
/// bits however places are divided into batches, and among threads.
void evaluate_surface(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                      const WaveSurfaceArrays& out);

/// How linear theory, which holds up to the mean level, is used up to the real surface.
enum class Stretching {
  /// Wheeler (1970): what the theory has at z' = h (z - elevation) / (h + elevation), in deep water z - elevation.
  /// The total pressure at the surface is zero, short waves on top of long ones keep their own velocity, and to first
  /// order the result is that of the Lagrangian solution (evaluate_displacement). Crest velocities are a little low.
  kWheeler,
  /// z as it is; above the mean level what the theory has at the mean level. Exact potential flow below the mean level,
  /// but in the troughs of long waves short ones fade away before the surface is reached.
  kNone
};

/// What the water does below the surface, arrays of one length.
struct WaveMotionArrays {
  std::span<float> velocity_x, velocity_y, velocity_z;              ///< m/s
  std::span<float> acceleration_x, acceleration_y, acceleration_z;  ///< m/s^2, d velocity / dt at a fixed place
  std::span<float> pressure;  ///< m^2/s^2, dynamic pressure over density: p = rho (pressure - g z), z from mean level
};

/// Evaluates the motion at (x[i], y[i]) m from the anchor and z[i] m above the mean level (below it: negative):
///   u = sum a omega C cos(theta) k^ ,  w = sum a omega S sin(theta) ,  p / rho = sum a omega^2 / k C cos(theta)
///   C = cosh k(z + h) / sinh kh ,  S = sinh k(z + h) / sinh kh ,  both e^(kz) in deep water
/// Places above the surface take the values at the surface, places below the bottom those at the bottom. While a blend
/// runs, the velocities are the weighted sums of both seas' own; what the changing weights add to the surface's rate is
/// not in w. Acceleration and pressure may be left out (empty spans, all four together). Bits as evaluate_surface.
void evaluate_motion(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                     std::span<const float> z, Stretching stretching, const WaveMotionArrays& out);

/// Where the particle whose place at rest is (x, y, z) is, less that place: the Lagrangian solution of first order.
///   horizontal: -sum a C sin(theta) k^ ;  vertical: sum (a S cos(theta) + k a^2 C S / 2)
/// Crests sharpen and troughs flatten; the last term keeps the mean level. z: m above the mean level, at most 0 counts.
void evaluate_displacement(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                           std::span<const float> z, std::span<float> shift_x, std::span<float> shift_y,
                           std::span<float> shift_z);

/// The displaced surface as seen from fixed places, arrays of one length.
struct DisplacedSurfaceArrays {
  std::span<float> height;                              ///< m above the mean level
  std::span<float> slope_x, slope_y;                    ///< d height / dx, / dy
  std::span<float> velocity_x, velocity_y, velocity_z;  ///< m/s, of the water at the surface
};

/// The surface that evaluate_displacement makes of the mean level, at the places (x[i], y[i]) where it stands then, m
/// from the anchor: the one that is drawn. The particle that has come to a place is found by Newton's method, four
/// steps: the error is below 0.1 mm while the waves' steepness, sum of a k, stays below 0.5; beyond 1 the surface may
/// fold and the answer is one of its sheets. Bits as evaluate_surface.
void evaluate_displaced_surface(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                                const DisplacedSurfaceArrays& out);

/// The surface at one place, m from the anchor: evaluate_surface of a batch of one.
struct WavePoint {
  float elevation = 0, slope_x = 0, slope_y = 0, rate = 0;
};
[[nodiscard]] WavePoint surface_at(const WaveMoment& moment, float x, float y);

/// The water at one place: evaluate_motion of a batch of one.
struct WaveMotion {
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero(), acceleration = Eigen::Vector3f::Zero();
  float pressure = 0;
};
[[nodiscard]] WaveMotion motion_at(const WaveMoment& moment, const Eigen::Vector3f& place, Stretching stretching);

}  // namespace pelagos
