#pragma once

#include "simulation/scene_sea.hpp"
#include "waves/wave_system.hpp"
#include "waves/wind_sea.hpp"

namespace pelagos {

/// s of simulated time between two seas that the wind has raised; the waves blend from one into the next meanwhile.
inline constexpr double kSeaRenewal = 30.0;

/// s of simulated time for which the wind counts as steady.
inline constexpr double kSeaGrowth = 1.0;

/// @param wind  m/s, at 10 m; its level part counts
[[nodiscard]] SteadyWind steady_wind(const Eigen::Vector3d& wind);

/// A sea that grows with the wind from `time` on, s. @param settings  with a wind_sea
[[nodiscard]] GrowingSea start_growing(const SeaSettings& settings, const WindSea& now, double time);

/// The systems that were asked for beside the wind sea, and that as the first of them where there is one to see.
[[nodiscard]] SeaSettings present_sea(const GrowingSea& sea, double gravity);

/// Whether the sea differs from the one that is shown: by 1 % of its height or period, or a degree.
[[nodiscard]] bool needs_renewal(const GrowingSea& sea);

}  // namespace pelagos
