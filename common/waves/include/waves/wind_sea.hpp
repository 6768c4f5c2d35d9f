#pragma once

#include <optional>

namespace pelagos {

/// A wind sea that the wind raises, turns and lets die down.
struct WindSeaSettings {
  double fetch = 300e3;             ///< m, > 0: of open water upwind
  std::optional<double> blown_for;  ///< s that the wind has blown already; none: so long that only the fetch counts
  double pace = 1.0;                ///< > 0: how many times as fast as in nature the sea changes

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("fetch", self.fetch);
    visit("blown_for", self.blown_for);
    visit("pace", self.pace);
  }
};

/// The mean wind at 10 m above the sea.
struct SteadyWind {
  double speed = 0.0;   ///< m/s
  double to_deg = 0.0;  ///< degrees clockwise from north, towards
};

/// What the wind has raised by now.
struct WindSea {
  double height = 0.0;       ///< m, significant
  double peak_period = 0.0;  ///< s
  double to_deg = 0.0;       ///< degrees clockwise from north, towards

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("height", self.height);
    visit("peak_period", self.peak_period);
    visit("to_deg", self.to_deg);
  }
};

/// The sea of a wind that has blown for ever over a fetch, in deep water (Wilson 1965, in the form of Goda 2003):
///   H_s = 0.30 U^2/g (1 - [1 + 0.004 (g F / U^2)^(1/2)]^-2)
///   T_s = 8.61 U/g   (1 - [1 + 0.008 (g F / U^2)^(1/3)]^-5) ,  T_p = 1.05 T_s
/// @param fetch  m, F   @param gravity  m/s^2, > 0
[[nodiscard]] WindSea developed_sea(const SteadyWind& wind, double fetch, double gravity);

/// m: the fetch whose sea needs so long to grow (Wilson 1965): t = F^0.73 U^-0.46, in hours, km, m/s.
[[nodiscard]] double fetch_after(double seconds, double wind_speed);
/// The inverse, s.
[[nodiscard]] double time_to_grow(double fetch, double wind_speed);

/// The sea at the start: of the fetch, or of the time that the wind has blown, whichever is less.
[[nodiscard]] WindSea start_wind_sea(const WindSeaSettings& settings, const SteadyWind& wind, double gravity);

/// The sea after a time in which the wind was steady.
/// - Lower than the wind can raise it, it grows: from the fetch at which this wind has that height, along the laws
/// above.
/// - Higher than that, it falls to it, by 1/e in 6 hours, and keeps its period.
/// - Its direction turns to the wind's, by 1/e in an hour.
/// (The two times are round figures for exercises; swell that leaves the area is a system of its own.)
/// @param seconds  of the clock; the sea's own time is `pace` times as long
[[nodiscard]] WindSea wind_sea_after(const WindSea& sea, const WindSeaSettings& settings, const SteadyWind& wind,
                                     double seconds, double gravity);

/// The peak factor of JONSWAP for a height and a peak period (DNV-RP-C205 2010, 3.5.5): 5 for T_p/sqrt(H_s) up to 3.6,
/// 1 from 5 on, exp(5.75 - 1.15 T_p/sqrt(H_s)) between.
[[nodiscard]] double peak_factor(const WindSea& sea);

}  // namespace pelagos
