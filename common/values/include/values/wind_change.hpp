#pragma once

#include <optional>

#include "text/refusal.hpp"
#include "values/wind.hpp"

namespace pelagos {

struct SetWind;

/// A wind of which some is left out: that is taken from the wind that was last set when the change takes effect. The
/// mean is given as `velocity`, or by `speed` and `from_deg`.
struct WindChange {
  WindChange() = default;
  /// Leaves nothing out.
  WindChange(const WindSettings& wind);  // NOLINT: a whole wind is a change

  std::optional<Eigen::Vector3d> velocity;  ///< m/s, TOWARDS
  std::optional<double> speed;              ///< m/s
  std::optional<double> from_deg;           ///< degrees clockwise from north
  std::optional<double> amplitude, length, beta, roughness;
  std::optional<WindPulse> pulse;
  bool clear_pulse = false;  ///< no pulse, whatever the present wind has
  std::optional<WindLaw> law;
};

/// The wind that a change makes. A law that replaces another one brings its own roughness.
/// @param present  the wind last set; nothing: no wind, and the mean must be given in full
/// @param wind     out: only where nothing is wrong
/// @return what is wrong; its field is one of the message Wind (proto/wind.proto), or "clear_pulse"
[[nodiscard]] std::optional<Refusal> merge_wind(const WindChange& change, const std::optional<WindSettings>& present,
                                                WindSettings& wind);
/// The same for a command; the field of what is wrong is one of the message SetWind: "wind.speed".
[[nodiscard]] std::optional<Refusal> merge_wind(const SetWind& command, const std::optional<WindSettings>& present,
                                                WindSettings& wind);

}  // namespace pelagos
