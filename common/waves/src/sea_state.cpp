#include "waves/sea_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scales/angles.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {

namespace {

constexpr double kPi = std::numbers::pi;

struct BeaufortForce {
  double least_wind;   ///< m/s
  double wave_height;  ///< m
};
constexpr std::array<BeaufortForce, kLargestBeaufort + 1> kBeaufort{{{0.0, 0.0},
                                                                     {0.3, 0.1},
                                                                     {1.6, 0.2},
                                                                     {3.4, 0.6},
                                                                     {5.5, 1.0},
                                                                     {8.0, 2.0},
                                                                     {10.8, 3.0},
                                                                     {13.9, 4.0},
                                                                     {17.2, 5.5},
                                                                     {20.8, 7.0},
                                                                     {24.5, 9.0},
                                                                     {28.5, 11.5},
                                                                     {32.7, 14.0}}};

constexpr double kLowestRatio = 0.7;   ///< of the peak frequency; below lies 0.5 % of the energy
constexpr double kHighestRatio = 5.0;  ///< above lies 0.2 % of the energy, short ripples that the viewer adds

/// Part of the Pierson-Moskowitz spectrum's energy below `ratio` times the peak frequency.
double energy_below(double ratio) { return std::exp(-1.25 / (ratio * ratio * ratio * ratio)); }

/// Spreading exponent s, Mitsuyasu et al. (1975).
double spreading_exponent(double ratio) {
  constexpr double kLargest = 10.0;
  return kLargest * (ratio < 1.0 ? std::pow(ratio, 5.0) : std::pow(ratio, -2.5));
}

/// The angle below which lies the part `quantile` of the density cos^2s(theta/2) on [-pi, pi].
double spreading_angle(double s, double quantile) {
  constexpr int kSteps = 512;
  std::array<double, kSteps + 1> cumulative{};
  double previous = 0.0;  // the density at -pi
  for (int i = 1; i <= kSteps; ++i) {
    const double theta = -kPi + 2.0 * kPi * i / kSteps;
    const double density = std::pow(std::max(std::cos(0.5 * theta), 0.0), 2.0 * s);
    cumulative[static_cast<std::size_t>(i)] = cumulative[static_cast<std::size_t>(i - 1)] + 0.5 * (previous + density);
    previous = density;
  }
  const double target = quantile * cumulative[kSteps];
  const auto above = std::upper_bound(cumulative.begin(), cumulative.end() - 1, target);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cumulative.begin(), 1));
  const double step = cumulative[i] - cumulative[i - 1];
  const double part = step > 0.0 ? (target - cumulative[i - 1]) / step : 0.5;
  return -kPi + 2.0 * kPi * (static_cast<double>(i - 1) + part) / kSteps;
}

}  // namespace

double significant_wave_height(int beaufort) {
  return kBeaufort[static_cast<std::size_t>(std::clamp(beaufort, 0, kLargestBeaufort))].wave_height;
}

double douglas_wave_height(int degree) {
  constexpr std::array<double, kHighestDouglas + 1> kHeights{0.0, 0.05, 0.3, 0.875, 1.875, 3.25, 5.0, 7.5, 11.5, 14.0};
  return kHeights[static_cast<std::size_t>(std::clamp(degree, 0, kHighestDouglas))];
}

int beaufort_number(double wind_speed) {
  int number = 0;
  while (number < kLargestBeaufort && wind_speed >= kBeaufort[static_cast<std::size_t>(number + 1)].least_wind)
    ++number;
  return number;
}

double peak_frequency(double significant_height, double gravity) {
  // B = 4 A / Hs^2 with A = 0.0081 g^2, omega_p^4 = 4 B / 5
  return std::pow(0.8 * 4.0 * 0.0081, 0.25) * std::sqrt(gravity / significant_height);
}

std::vector<WaveComponent> make_wave_components(const SeaState& sea) {
  const double height = significant_wave_height(sea.beaufort);
  if (height <= 0.0 || sea.components == 0 || !(sea.gravity > 0.0)) return {};
  const double peak = peak_frequency(height, sea.gravity);
  const double count = sea.components;
  const double band_ratio = kHighestRatio / kLowestRatio;
  const double whole = energy_below(kHighestRatio) - energy_below(kLowestRatio);
  const double main_direction = 0.5 * kPi - sea.wave_to_deg * kPi / 180.0;  // compass to anticlockwise from east

  SplitMix64 random(sea.seed);
  const double first_quantile = random.next_unit();
  std::vector<WaveComponent> components;
  components.reserve(sea.components);
  for (std::uint32_t i = 0; i < sea.components; ++i) {
    const double lower = kLowestRatio * std::pow(band_ratio, i / count);
    const double upper = kLowestRatio * std::pow(band_ratio, (i + 1) / count);
    const double ratio = lower * std::pow(upper / lower, random.next_unit());
    const double variance = height * height / 16.0 * (energy_below(upper) - energy_below(lower)) / whole;
    const double quantile = first_quantile + i * kGoldenPart;
    const double spread = spreading_angle(spreading_exponent(ratio), quantile - std::floor(quantile));
    const double omega = ratio * peak;
    components.push_back({.amplitude = static_cast<float>(std::sqrt(2.0 * variance)),
                          .wavenumber = static_cast<float>(omega * omega / sea.gravity),
                          .omega = static_cast<float>(omega),
                          .direction = static_cast<float>(std::remainder(main_direction + spread, 2.0 * kPi)),
                          .phase = static_cast<float>(2.0 * kPi * random.next_unit())});
  }
  return components;
}

}  // namespace pelagos
