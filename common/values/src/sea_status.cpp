#include <algorithm>
#include <cmath>

#include "values/status.hpp"

namespace pelagos {

namespace {

/// rad: of the sum of the directions of all components, each counted by its energy.
double mean_direction(std::span<const WaveComponent> waves) {
  double x = 0.0, y = 0.0;
  for (const WaveComponent& wave : waves) {
    const double energy = static_cast<double>(wave.amplitude) * static_cast<double>(wave.amplitude);
    x += energy * std::cos(static_cast<double>(wave.direction));
    y += energy * std::sin(static_cast<double>(wave.direction));
  }
  return std::atan2(y, x);
}

}  // namespace

SeaStatus sea_status(const WaveField& sea, double time, const std::optional<SeaRequest>& request) {
  SeaStatus status;
  status.request = request;
  const std::span<const WaveComponent> waves = sea.components();
  const std::span<const WaveLayer> layers = sea.layers();
  status.significant_height = 4.0 * std::sqrt(wave_variance(waves));
  status.mean_direction = mean_direction(waves);
  status.waves = static_cast<std::uint32_t>(waves.size());
  const auto lower = [](const WaveComponent& a, const WaveComponent& b) { return a.amplitude < b.amplitude; };
  if (!waves.empty()) status.highest = *std::max_element(waves.begin(), waves.end(), lower);
  for (std::size_t i = layers.size() - 1; i > 0 && layers[i].share_at(time) < 1.0; --i) ++status.earlier;
  if (status.earlier == 0) return status;
  status.share = layers.back().share_at(time);
  status.blend_left = layers.back().start + layers.back().seconds - time;
  return status;
}

}  // namespace pelagos
