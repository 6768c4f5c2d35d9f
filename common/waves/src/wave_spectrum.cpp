#include "waves/wave_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "waves/sea_state.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kSteps = 2048;
constexpr double kTurn = 2.0 * std::numbers::pi;
/// Of the energy in the shares of bands. The more of it, the closer lie the frequencies about the peak, and the longer
/// takes a record that tells them apart: with 100 components an hour has the significant height within 0.6 % (standard
/// deviation; wind sea of 7 s) and within 1.4 % (swell of 13 s, gamma 7).
constexpr double kEnergyWeight = 1.0 / 3.0;
constexpr double kCutOff = 1e-4;  ///< energy that may lie beyond either end

double log_step() { return std::log(WaveSpectrum::kLast / WaveSpectrum::kFirst) / kSteps; }

double ratio_at(std::size_t point) { return WaveSpectrum::kFirst * std::exp(static_cast<double>(point) * log_step()); }

double peak_factor(double ratio, double gamma) {
  const double sigma = ratio <= 1.0 ? 0.07 : 0.09, away = (ratio - 1.0) / sigma;
  return std::pow(gamma, std::exp(-0.5 * away * away));
}

/// Kitaigorodskii's factor of the saturation range in water of finite depth.
double depth_factor(double omega, double depth, double gravity) {
  const double kh = wave_number(omega, depth, gravity) * depth;
  if (!(kh < 20.0)) return 1.0;
  const double t = std::tanh(kh);
  return t * t / (1.0 + 2.0 * kh / std::sinh(2.0 * kh));
}

double pierson_moskowitz(double ratio, double shape) {
  const double power = 4.0 * shape + 1.0;
  return std::pow(ratio, -power) * std::exp(-0.25 * power * std::pow(ratio, -4.0));
}

double density(const WaveSystem& system, double ratio, double peak_omega, double depth, double gravity) {
  switch (system.spectrum) {
    case SpectrumKind::kPiersonMoskowitz:
    case SpectrumKind::kRegular:
      break;
    case SpectrumKind::kOchiHubble:
      return pierson_moskowitz(ratio, system.shape);
    case SpectrumKind::kJonswap:
      return pierson_moskowitz(ratio, 1.0) * peak_factor(ratio, system.gamma);
    case SpectrumKind::kTma:
      return pierson_moskowitz(ratio, 1.0) * peak_factor(ratio, system.gamma) *
             depth_factor(ratio * peak_omega, depth, gravity);
  }
  return pierson_moskowitz(ratio, 1.0);
}

}  // namespace

WaveSpectrum::WaveSpectrum(const WaveSystem& system, double peak_period, double depth, double gravity)
    : below_(kSteps + 1) {
  const double peak_omega = kTurn / peak_period;
  // trapezoids in log r: dr = r d(log r)
  SpectrumMoments last{};
  for (std::size_t point = 0; point <= kSteps; ++point) {
    const double ratio = ratio_at(point);
    double value = density(system, ratio, peak_omega, depth, gravity) * ratio;
    for (std::size_t n = 0; n < last.size(); ++n, value *= ratio) {
      if (point > 0) below_[point][n] = below_[point - 1][n] + 0.5 * (last[n] + value) * log_step();
      last[n] = value;
    }
  }
  const double whole = below_.back()[0];
  for (SpectrumMoments& moments : below_)
    for (double& moment : moments) moment /= whole;
  const auto less = [](const SpectrumMoments& moments, double energy) { return moments[0] < energy; };
  const auto first = std::lower_bound(below_.begin(), below_.end(), kCutOff, less);
  const auto last_point = std::lower_bound(below_.begin(), below_.end() - 1, 1.0 - kCutOff, less);
  lowest_ = ratio_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(first - below_.begin() - 1, 0)));
  highest_ = ratio_at(static_cast<std::size_t>(last_point - below_.begin()));
}

SpectrumMoments WaveSpectrum::below(double ratio) const {
  const double place = std::clamp(std::log(ratio / kFirst) / log_step(), 0.0, static_cast<double>(kSteps));
  const std::size_t point = std::min(static_cast<std::size_t>(place), kSteps - 1);
  const double part = place - static_cast<double>(point);
  SpectrumMoments moments;
  for (std::size_t n = 0; n < moments.size(); ++n)
    moments[n] = below_[point][n] + part * (below_[point + 1][n] - below_[point][n]);
  return moments;
}

SpectrumMoments WaveSpectrum::moments(double lower, double upper) const {
  SpectrumMoments to = below(upper);
  const SpectrumMoments from = below(lower);
  for (std::size_t n = 0; n < to.size(); ++n) to[n] -= from[n];
  return to;
}

SpectrumMoments WaveSpectrum::moments() const { return below_.back(); }

std::vector<double> WaveSpectrum::band_edges(double lower, double upper, std::size_t count) const {
  const double energy_before = below(lower)[0], energy = below(upper)[0] - energy_before;
  const double log_range = std::log(upper / lower);
  const auto share = [&](double ratio) {
    return kEnergyWeight * (below(ratio)[0] - energy_before) / energy +
           (1.0 - kEnergyWeight) * std::log(ratio / lower) / log_range;
  };
  std::vector<double> edges(count + 1, upper);
  edges[0] = lower;
  for (std::size_t band = 1; band < count; ++band) {
    const double wanted = static_cast<double>(band) / static_cast<double>(count);
    double from = edges[band - 1], to = upper;
    constexpr int kHalvings = 48;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = std::sqrt(from * to);
      (share(middle) < wanted ? from : to) = middle;
    }
    edges[band] = to;
  }
  return edges;
}

double peak_period(const WaveSystem& system, double depth, double gravity) {
  if (!(system.period > 0.0)) return kTurn / peak_frequency(system.height, gravity);
  if (system.period_kind == PeriodKind::kPeak || system.spectrum == SpectrumKind::kRegular) return system.period;
  double peak = system.period;
  // Only TMA's shape depends on the period; its ratio of periods changes slowly, so a few rounds suffice.
  const bool of_depth = system.spectrum == SpectrumKind::kTma && std::isfinite(depth);
  const int rounds = of_depth ? 8 : 1;
  for (int round = 0; round < rounds; ++round) {
    const SpectrumMoments m = WaveSpectrum(system, peak, depth, gravity).moments();
    const double ratio =
        system.period_kind == PeriodKind::kMean ? m[1] / m[0] : std::sqrt(m[2] / m[0]);  // peak over given period
    peak = system.period * ratio;
  }
  return peak;
}

}  // namespace pelagos
