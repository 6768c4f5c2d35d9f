#pragma once

#include "waves/wave_system.hpp"

namespace pelagos {

/// The exponent s of the density cos^2s(theta / 2) of directions at r = omega / omega_p. By frequency it is that of
/// Mitsuyasu et al. (1975) as Goda (2010, eq. 2.24) has it: spreading r^5 below the peak, spreading r^-2.5 above it.
/// @return at least 0.5; of kLongCrested: infinite
[[nodiscard]] double spreading_exponent(const WaveSystem& system, double ratio);

/// rad in [-pi, pi]: below it lies the part `quantile` (0 to 1) of the density cos^2s(theta / 2). Error below 0.01 of
/// the density's width. Infinite s: 0.
[[nodiscard]] double spreading_angle_of(double s, double quantile);

}  // namespace pelagos
