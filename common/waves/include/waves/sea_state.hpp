#pragma once

#include <cstdint>
#include <vector>

#include "scales/scales.hpp"
#include "waves/wave_components.hpp"

namespace pelagos {

inline constexpr int kLargestBeaufort = 12;

/// Probable wave height of the open sea by Beaufort number, m, taken as the significant wave height.
/// The heights usually printed beside the scale; numbers outside 0..12 are clamped.
[[nodiscard]] double significant_wave_height(int beaufort);

inline constexpr int kHighestDouglas = 9;

/// Significant wave height of a degree of the Douglas sea scale (WMO code table 3700), m: the middle of its range, of
/// degree 9 ("over 14 m") 14 m. Numbers outside 0..9 are clamped.
[[nodiscard]] double douglas_wave_height(int degree);

/// Beaufort number of a 10 m wind speed in m/s (10 minute mean); negative or not finite gives 0.
[[nodiscard]] int beaufort_number(double wind_speed);

/// Frequency of the spectrum's peak for a fully developed sea, rad/s: the Pierson-Moskowitz spectrum (1964) expressed
/// by its significant height has A = 0.0081 g^2, A / (4 B) = Hs^2 / 16 and omega_p^4 = 4 B / 5 = 0.0259 g^2 / Hs^2.
/// @param significant_height m, > 0   @param gravity m/s^2, > 0
[[nodiscard]] double peak_frequency(double significant_height, double gravity);

/// What the components of a far sea are made from.
struct SeaState {
  int beaufort = 0;          ///< 0 (flat) to 12
  double wave_to_deg = 0.0;  ///< main direction, the way the crests move, clockwise from north
  std::uint32_t components = 24;
  std::uint64_t seed = 1;
  double gravity = kStandardGravity;  ///< m/s^2, > 0
};

/// Components of a fully developed deep-water sea.
/// Frequencies: one in each of `components` bands that divide [0.7, 5] omega_p geometrically, drawn by the seed. The
/// energy of a band is the exact integral of the Pierson-Moskowitz spectrum (1964)
///   S = 5/16 Hs^2 omega_p^4 omega^-5 exp(-5/4 (omega_p/omega)^4) ,
/// scaled so that 4 sqrt(variance) = Hs exactly whatever the number of bands. Geometric bands give short waves about
/// equal slopes, so that few components already look like a sea.
/// Directions: cos^2s(theta/2) about the main one, s as Mitsuyasu et al. (1975) with Goda's largest value of 10 for
/// wind waves; directions are spread evenly over the quantiles by a golden-ratio sequence. The same arguments give the
/// same components on machines whose sin, cos, pow and log agree to single precision. Beaufort 0 or no components:
/// empty.
[[nodiscard]] std::vector<WaveComponent> make_wave_components(const SeaState& sea);

}  // namespace pelagos
