#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "text/refusal.hpp"
#include "waves/dispersion.hpp"
#include "waves/wave_components.hpp"

namespace pelagos {

/// One wave as a scene or a command gives it.
struct WaveSettings {
  double amplitude = 0.0;  ///< m
  double length = 0.0;     ///< m; 0: by its period
  double period = 0.0;     ///< s; 0: by its length
  double to_deg = 0.0;     ///< degrees clockwise from north, the way the crests run
  double phase_deg = 0.0;  ///< degrees, at the world's origin at time 0
};

/// Waves of a sea. Eight seas that blend (WaveField::kMostLayers) are as many as a viewer takes.
inline constexpr std::size_t kMostWaves = 512;

/// Height over length of the highest deep-water wave before it breaks (Michell 1893).
inline constexpr double kHighestSlenderness = 0.1412;
/// m, significant: half as much again as the highest that was measured at sea.
inline constexpr double kHighestSea = 30.0;

/// The wave as the wave field has it.
/// @param gravity  m/s^2, > 0   @param depth  m, > 0, of the sea
[[nodiscard]] WaveComponent wave_component(const WaveSettings& wave, double gravity, double depth = kInfiniteDepth);
[[nodiscard]] std::vector<WaveComponent> wave_components(std::span<const WaveSettings> waves, double gravity,
                                                         double depth = kInfiniteDepth);

/// m: 4 sqrt(variance).
[[nodiscard]] double significant_height(std::span<const WaveSettings> waves);

/// @return what makes waves no sea: one that is steeper than a breaking one, or all together too steep or too high. The
///         field is "wave[2].amplitude" or "wave".
[[nodiscard]] std::optional<Refusal> find_wave_refusal(std::span<const WaveSettings> waves, double gravity);

}  // namespace pelagos
