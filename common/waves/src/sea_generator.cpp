#include "waves/sea_generator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "scales/angles.hpp"
#include "waves/splitmix.hpp"
#include "waves/wave_spectrum.hpp"
#include "waves/wave_spreading.hpp"

namespace pelagos {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A component before it is rounded; its direction is relative to the system's.
struct Wave {
  double variance = 0.0, ratio = 0.0, direction = 0.0, phase = 0.0;
};

bool is_flat(const WaveSystem& system) { return !(system.height > 0.0); }

/// Uniform in [1/4, 3/4): of two parts side by side the values stay half a part apart.
double middle_half(SplitMix64& random) { return 0.25 + 0.5 * random.next_unit(); }

/// rad/s of the shortest wave that is wanted; infinite without one.
double highest_frequency(const SeaSettings& sea, const SeaPlace& place) {
  if (!(sea.shortest_length > 0.0)) return std::numeric_limits<double>::infinity();
  return wave_frequency(kTurn / sea.shortest_length, place.depth, place.gravity);
}

WaveComponent component_of(const Wave& wave, double omega, double to_deg, const SeaPlace& place) {
  const double main = (90.0 - to_deg) * kRadiansPerDegree;  // compass to anticlockwise from east
  WaveComponent component;
  component.amplitude = static_cast<float>(std::sqrt(2.0 * wave.variance));
  component.wavenumber = static_cast<float>(wave_number(omega, place.depth, place.gravity));
  component.omega = static_cast<float>(omega);
  component.direction = static_cast<float>(std::remainder(main + wave.direction, kTurn));
  component.phase = static_cast<float>(wave.phase);
  return component;
}

/// For each of `count` waves a place in 0..1, one in each of `count` equal parts, in the order of a golden-ratio
/// sequence from `first` on: neighbours are far apart.
std::vector<double> deal_quantiles(std::size_t count, double first) {
  std::vector<double> sequence(count), quantiles(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double place = first + static_cast<double>(i) * kGoldenPart;
    sequence[i] = place - std::floor(place);
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sequence[a] < sequence[b]; });
  for (std::size_t part = 0; part < count; ++part)
    quantiles[order[part]] = (static_cast<double>(part) + 0.5) / static_cast<double>(count);
  return quantiles;
}

/// How far quantiles go along with their index. Outer ones count more, as they do among angles.
double trend_of(std::span<const double> quantiles) {
  double trend = 0.0;
  for (std::size_t i = 0; i < quantiles.size(); ++i)
    trend += (static_cast<double>(i) - 0.5 * static_cast<double>(quantiles.size() - 1)) *
             std::log(quantiles[i] / (1.0 - quantiles[i]));
  return std::abs(trend);
}

/// Of some such orders that the seed starts the one with the least trend.
std::vector<double> draw_quantiles(std::size_t count, SplitMix64& random) {
  constexpr int kTries = 8;
  std::vector<double> best;
  for (int n = 0; n < kTries; ++n) {
    std::vector<double> quantiles = deal_quantiles(count, random.next_unit());
    if (best.empty() || trend_of(quantiles) < trend_of(best)) best = std::move(quantiles);
  }
  return best;
}

/// Bands of the spectrum up to a ratio: of each its energy, a frequency, a direction and a phase.
std::vector<Wave> draw_waves(const WaveSystem& system, const WaveSpectrum& spectrum, double upper, std::size_t count,
                             SplitMix64& random) {
  const std::vector<double> edges = spectrum.band_edges(spectrum.lowest(), upper, count);
  const std::vector<double> quantiles = draw_quantiles(count, random);
  std::vector<Wave> waves(count);
  for (std::size_t i = 0; i < count; ++i) {
    Wave& wave = waves[i];
    // The first band has also what lies below the lowest frequency, and the last one what lies above the highest.
    const double from = i == 0 ? WaveSpectrum::kFirst : edges[i];
    const double to = i + 1 == count && upper == spectrum.highest() ? WaveSpectrum::kLast : edges[i + 1];
    wave.variance = system.height * system.height / 16.0 * spectrum.moments(from, to)[0];
    wave.ratio = edges[i] * std::pow(edges[i + 1] / edges[i], middle_half(random));
    wave.direction = spreading_angle_of(spreading_exponent(system, wave.ratio), quantiles[i]);
    wave.phase = kTurn * random.next_unit();
  }
  return waves;
}

/// Turns all directions by the one angle that makes their mean by energy zero.
void centre_directions(std::vector<Wave>& waves) {
  double along = 0.0, across = 0.0;
  for (const Wave& wave : waves) {
    along += wave.variance * std::cos(wave.direction);
    across += wave.variance * std::sin(wave.direction);
  }
  const double mean = std::atan2(across, along);
  for (Wave& wave : waves) wave.direction -= mean;
}

/// Multiplies all frequencies by the one factor that gives them the spectrum's mean.
void fit_period(const WaveSystem& system, const SpectrumMoments& wanted, double upper, std::vector<Wave>& waves) {
  SpectrumMoments have{};
  for (const Wave& wave : waves) {
    have[0] += wave.variance;
    have[1] += wave.variance * wave.ratio;
    have[2] += wave.variance * wave.ratio * wave.ratio;
  }
  const double factor = system.period_kind == PeriodKind::kZeroCrossing
                            ? std::sqrt(wanted[2] / wanted[0] * have[0] / have[2])
                            : wanted[1] / wanted[0] * have[0] / have[1];
  for (Wave& wave : waves) wave.ratio = std::min(wave.ratio * factor, upper);
}

void add_regular(const WaveSystem& system, double highest, const SeaPlace& place, SeaComponents& out) {
  const double variance = system.height * system.height / 8.0, omega = kTurn / system.period;
  out.variance += variance;
  if (omega > highest) {
    out.left_out += variance;
    return;
  }
  const Wave wave{variance, 1.0, 0.0, system.phase_deg * kRadiansPerDegree};
  out.waves.push_back(component_of(wave, omega, system.to_deg, place));
}

void add_spectrum(const WaveSystem& system, std::size_t count, double highest, const SeaPlace& place,
                  SplitMix64& random, SeaComponents& out) {
  const double peak = peak_period(system, place.depth, place.gravity), peak_omega = kTurn / peak;
  const WaveSpectrum spectrum(system, peak, place.depth, place.gravity);
  const double variance = system.height * system.height / 16.0;
  const double limit = highest / peak_omega;
  out.variance += variance;
  if (limit <= spectrum.lowest()) {
    out.left_out += variance;
    return;
  }
  const bool cut = limit < spectrum.highest();
  const double upper = cut ? limit : spectrum.highest();
  const SpectrumMoments kept = cut ? spectrum.moments(WaveSpectrum::kFirst, upper) : spectrum.moments();
  out.left_out += variance * (1.0 - kept[0]);
  std::vector<Wave> waves = draw_waves(system, spectrum, upper, count, random);
  centre_directions(waves);
  fit_period(system, kept, limit, waves);
  for (const Wave& wave : waves) out.waves.push_back(component_of(wave, wave.ratio * peak_omega, system.to_deg, place));
}

}  // namespace

std::vector<std::uint32_t> share_components(const SeaSettings& sea) {
  std::vector<std::uint32_t> shares;
  std::uint32_t rest = sea.components, left = 0;
  for (const WaveSystem& system : sea.systems) {
    const bool regular = system.spectrum == SpectrumKind::kRegular && !is_flat(system);
    shares.push_back(regular ? 1 : 0);
    rest -= std::min(rest, shares.back());
    if (!regular && !is_flat(system)) ++left;
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] != 0 || is_flat(sea.systems[i])) continue;
    shares[i] = std::max((rest + left - 1) / left, 1U);
    rest -= std::min(rest, shares[i]);
    --left;
  }
  return shares;
}

SeaComponents make_sea_components(const SeaSettings& sea, const SeaPlace& place) {
  const std::vector<std::uint32_t> shares = share_components(sea);
  const double highest = highest_frequency(sea, place);
  SplitMix64 seeds(sea.seed.value_or(place.seed));
  SeaComponents out;
  for (std::size_t i = 0; i < sea.systems.size(); ++i) {
    SplitMix64 random(seeds.next());  // of its own: another system does not change this one
    if (shares[i] == 0) continue;
    if (sea.systems[i].spectrum == SpectrumKind::kRegular)
      add_regular(sea.systems[i], highest, place, out);
    else
      add_spectrum(sea.systems[i], shares[i], highest, place, random, out);
  }
  return out;
}

}  // namespace pelagos
