#include "values/wave_settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "waves/dispersion.hpp"

namespace pelagos {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// rad/m
double wavenumber_of(const WaveSettings& wave, double gravity, double depth) {
  return wave.length > 0.0 ? kTurn / wave.length : wave_number(kTurn / wave.period, depth, gravity);
}

/// rad/s
double omega_of(const WaveSettings& wave, double gravity, double depth) {
  return wave.period > 0.0 ? kTurn / wave.period : wave_frequency(kTurn / wave.length, depth, gravity);
}

}  // namespace

WaveComponent wave_component(const WaveSettings& wave, double gravity, double depth) {
  WaveComponent component;
  component.amplitude = static_cast<float>(wave.amplitude);
  component.wavenumber = static_cast<float>(wavenumber_of(wave, gravity, depth));
  component.omega = static_cast<float>(omega_of(wave, gravity, depth));
  component.direction = static_cast<float>((90.0 - wave.to_deg) * kTurn / 360.0);
  component.phase = static_cast<float>(wave.phase_deg * kTurn / 360.0);
  return component;
}

std::vector<WaveComponent> wave_components(std::span<const WaveSettings> waves, double gravity, double depth) {
  std::vector<WaveComponent> components;
  components.reserve(waves.size());
  for (const WaveSettings& wave : waves) components.push_back(wave_component(wave, gravity, depth));
  return components;
}

double significant_height(std::span<const WaveSettings> waves) {
  double variance = 0.0;
  for (const WaveSettings& wave : waves) variance += 0.5 * wave.amplitude * wave.amplitude;
  return 4.0 * std::sqrt(variance);
}

std::optional<Refusal> find_wave_refusal(std::span<const WaveSettings> waves, double gravity) {
  constexpr double kSteepest = 0.5 * kTurn * kHighestSlenderness;  // amplitude times wave number
  double squares = 0.0;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double k = wavenumber_of(waves[i], gravity, kInfiniteDepth), steepness = waves[i].amplitude * k;
    if (steepness > kSteepest)
      return Refusal{
          fmt::format("wave[{}].amplitude", i),
          fmt::format("{:g} m is too steep for a wave of {:.4g} m; allowed: at most {:.4g} m, where it breaks",
                      waves[i].amplitude, kTurn / k, kSteepest / k)};
    squares += steepness * steepness;
  }
  if (const double steepness = std::sqrt(squares); steepness > kSteepest)
    return Refusal{"wave", fmt::format("the waves together have a steepness (root of the sum of (amplitude k)^2) of "
                                       "{:.3g}; allowed: at most {:.3g}, that of one breaking wave",
                                       steepness, kSteepest)};
  if (const double height = significant_height(waves); height > kHighestSea)
    return Refusal{
        "wave", fmt::format("the waves together have a significant height of {:.3g} m; allowed: at most {:g} m", height,
                            kHighestSea)};
  return {};
}

}  // namespace pelagos
