#include <algorithm>
#include <cmath>

#include "values/status.hpp"

namespace pelagos {

SeaStatus sea_status(const WaveField& sea, double time, const std::optional<SeaRequest>& request) {
  SeaStatus status;
  status.request = request;
  const std::span<const WaveComponent> waves = sea.components();
  const std::span<const WaveLayer> layers = sea.layers();
  status.significant_height = 4.0 * std::sqrt(wave_variance(waves));
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
