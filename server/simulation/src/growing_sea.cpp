#include "simulation/growing_sea.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "values/current.hpp"
#include "values/wave_settings.hpp"

namespace pelagos {

namespace {

constexpr double kLeastHeight = 0.01;  // m: what a lower sea has is not worth a wave

/// m: a young sea is no steeper than any sea.
double possible_height(const WindSea& sea, double gravity) {
  const double length = gravity * sea.peak_period * sea.peak_period / (2.0 * std::numbers::pi);
  return std::min({sea.height, kSteepestSea * length, kHighestSea});
}

}  // namespace

SteadyWind steady_wind(const Eigen::Vector3d& wind) { return {wind.head<2>().norm(), current_to_deg(wind)}; }

GrowingSea start_growing(const SeaSettings& settings, const WindSea& now, double time) {
  return {settings, now, now, time, time + kSeaRenewal};
}

SeaSettings present_sea(const GrowingSea& sea, double gravity) {
  SeaSettings settings = sea.asked;
  WaveSystem system;
  system.height = possible_height(sea.now, gravity);
  if (system.height < kLeastHeight) return settings;
  system.period = sea.now.peak_period;
  system.to_deg = sea.now.to_deg;
  system.gamma = peak_factor(sea.now);
  settings.systems.insert(settings.systems.begin(), system);
  return settings;
}

bool needs_renewal(const GrowingSea& sea) {
  const WindSea &now = sea.now, &shown = sea.shown;
  return std::abs(now.height - shown.height) > 0.01 * std::max(shown.height, kLeastHeight) ||
         std::abs(now.peak_period - shown.peak_period) > 0.01 * shown.peak_period ||
         std::abs(std::remainder(now.to_deg - shown.to_deg, 360.0)) > 1.0;
}

}  // namespace pelagos
