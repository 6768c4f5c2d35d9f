#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "waves/wind_sea.hpp"

namespace pelagos {

/// How the energy of a system is spread over frequencies; see wave_spectrum.hpp.
enum class SpectrumKind : std::uint8_t { kJonswap, kPiersonMoskowitz, kTma, kOchiHubble, kRegular };

/// Which period of a system is given.
enum class PeriodKind : std::uint8_t {
  kPeak,          ///< Tp, of the spectrum's peak
  kZeroCrossing,  ///< Tz = Tm02, sqrt(m0 / m2)
  kMean           ///< Tm = Tm01, m0 / m1
};

/// How the energy of a system is spread over directions; see wave_spreading.hpp.
enum class SpreadingKind : std::uint8_t {
  kByFrequency,  ///< `spreading` is the exponent at the peak
  kConstant,     ///< `spreading` is the exponent at all frequencies
  kLongCrested   ///< all waves run in one direction
};

/// Waves that come from one place: a wind sea, a swell, or one regular wave.
struct WaveSystem {
  SpectrumKind spectrum = SpectrumKind::kJonswap;
  double height = 0.0;  ///< m, >= 0: the significant height; of a regular wave from trough to crest
  PeriodKind period_kind = PeriodKind::kPeak;
  double period = 0.0;  ///< s; 0: that of a fully developed sea of this height (sea_state.hpp), not of a regular wave
  double to_deg = 0.0;  ///< degrees clockwise from north, the way the waves run
  SpreadingKind spreading_kind = SpreadingKind::kByFrequency;
  double spreading = 10.0;  ///< s of cos^2s(theta / 2), > 0
  double gamma = 3.3;       ///< >= 1, of JONSWAP and TMA: the peak over that of Pierson and Moskowitz
  double shape = 1.0;       ///< > 0.25, lambda of Ochi and Hubble
  double phase_deg = 0.0;   ///< of a regular wave at the world's origin at time 0
  /// What the height and the period came from; for people.
  std::optional<int> douglas = {}, beaufort = {};

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("spectrum", self.spectrum);
    visit("height", self.height);
    visit("period_kind", self.period_kind);
    visit("period", self.period);
    visit("to_deg", self.to_deg);
    visit("spreading_kind", self.spreading_kind);
    visit("spreading", self.spreading);
    visit("gamma", self.gamma);
    visit("shape", self.shape);
    visit("phase_deg", self.phase_deg);
    visit("douglas", self.douglas);
    visit("beaufort", self.beaufort);
  }
};

/// The spreading exponent at the peak of a wind sea (Goda 2010, table 2.1).
inline constexpr double kWindSeaSpreading = 10.0;

/// A sea as an instructor asks for it.
struct SeaSettings {
  std::vector<WaveSystem> systems;
  std::uint32_t components = 100;                ///< in all
  std::optional<std::uint64_t> seed;             ///< none: the scene's
  double shortest_length = 0.0;                  ///< m: shorter waves are left out; 0: none are
  std::optional<WindSeaSettings> wind_sea = {};  ///< beside the systems: the one that the wind raises

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("systems", self.systems);
    visit("components", self.components);
    visit("seed", self.seed);
    visit("shortest_length", self.shortest_length);
    visit("wind_sea", self.wind_sea);
  }
};

}  // namespace pelagos
