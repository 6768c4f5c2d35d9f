#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "waves/dispersion.hpp"
#include "waves/wave_system.hpp"

namespace pelagos {

/// Moments of a spectrum as integrals of r^n over its energy, n = 0, 1, 2; r = omega / omega_p.
using SpectrumMoments = std::array<double, 3>;

/// The shape of a wave system's spectrum over r = omega / omega_p, in a table with 2048 steps in log r from 0.3 to 8.
/// Energy beyond belongs to no table: 0.03 % of the Pierson-Moskowitz spectrum.
///   Pierson and Moskowitz (1964):  r^-5 exp(-5/4 r^-4)
///   JONSWAP (Hasselmann et al. 1973):  the same times gamma^exp(-(r - 1)^2 / (2 sigma^2)), sigma 0.07 below the peak
///     and 0.09 above it
///   TMA (Bouws et al. 1985):  JONSWAP times tanh^2(k h) / (1 + 2 k h / sinh(2 k h)), the factor of Kitaigorodskii et
///     al. (1975); omega_p is that of the JONSWAP form. In deep water it is JONSWAP
///   Ochi and Hubble (1976), one of their two parts:  r^-(4 lambda + 1) exp(-(4 lambda + 1) / 4 r^-4)
/// A regular wave has no spectrum.
class WaveSpectrum {
 public:
  /// @param peak_period  s, and depth in m, and gravity in m/s^2: what TMA needs, all > 0
  WaveSpectrum(const WaveSystem& system, double peak_period, double depth, double gravity);

  /// Relative to the whole energy, between two ratios; those outside the table count as its ends.
  [[nodiscard]] SpectrumMoments moments(double lower, double upper) const;
  [[nodiscard]] SpectrumMoments moments() const;

  /// Ratios between which all but 0.01 % of the energy lies, at either end.
  [[nodiscard]] double lowest() const { return lowest_; }
  [[nodiscard]] double highest() const { return highest_; }

  /// Ratios that divide [lower, upper] into `count` bands, each with the same sum of a third of its share of the energy
  /// and two thirds of its share of log r. So the peak is resolved and short waves are there.
  /// @return count + 1 ratios, ascending
  [[nodiscard]] std::vector<double> band_edges(double lower, double upper, std::size_t count) const;

  static constexpr double kFirst = 0.3, kLast = 8.0;

 private:
  [[nodiscard]] SpectrumMoments below(double ratio) const;

  std::vector<SpectrumMoments> below_;  ///< up to each point of the table
  double lowest_ = kFirst, highest_ = kLast;
};

/// s: the peak period of a system whose peak, zero-crossing or mean period is given, or that is fully developed.
/// Moments are those of the table above; the zero-crossing period depends on where a spectrum is cut off (1 % longer
/// than up to infinity).
[[nodiscard]] double peak_period(const WaveSystem& system, double depth, double gravity);

}  // namespace pelagos
