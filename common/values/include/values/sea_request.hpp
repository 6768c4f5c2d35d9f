#pragma once

#include <optional>
#include <string>

#include "text/refusal.hpp"
#include "waves/wave_system.hpp"

namespace pelagos {

inline constexpr std::size_t kMostWaveSystems = 8;

/// Significant height over the length of a deep-water wave of the peak period: the steepest that was measured
/// (DNV-RP-C205 2010, 3.5.4, for peak periods up to 8 s).
inline constexpr double kSteepestSea = 1.0 / 15.0;

/// A sea that was asked for, beside the components that it became.
struct SeaRequest {
  SeaSettings settings;   ///< with the seed that it was made with
  double left_out = 0.0;  ///< m: significant height of the waves that were too short

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("settings", self.settings);
    visit("left_out", self.left_out);
  }
};

/// @return what makes systems no sea: one that is too steep for its period, all together too steep or too high, more
///         systems than components, or no wave that is long enough. The field is "system[1].height", "system",
///         "components" or "shortest_length".
[[nodiscard]] std::optional<Refusal> find_sea_refusal(const SeaSettings& sea, double gravity);

/// A system in words: "wind sea JONSWAP, Hs 2 m, Tp 7 s, to 250 deg, gamma 3.3, spreading 10 at the peak". It is told
/// as swell where its peak period is above 1.2 times that of a fully developed sea of its height.
[[nodiscard]] std::string describe_system(const WaveSystem& system);
/// All systems, how many components, and the shortest length.
[[nodiscard]] std::string describe_sea(const SeaSettings& sea);

}  // namespace pelagos
