#include "renderer/short_waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scales/scales.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr int kSide = ShortWaveTile::kSide;
constexpr std::size_t kTexels = std::size_t{kSide} * kSide;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Lengths of the tiles have no small common multiple, so that their repeats do not line up.
struct Band {
  double length;             ///< m, of the tile
  double longest, shortest;  ///< m, of its waves: (shortest, longest]
};
constexpr std::array<Band, kShortWaveTiles> kBands = {{{167.0, 60.0, 4.0}, {23.0, 4.0, 0.7}, {4.1, 0.7, 0.12}}};
constexpr std::array<double, kShortWaveTiles> kSpreading = {3.5, 2.8,
                                                            1.2};  // s of cos^2s of half the angle to the wind
constexpr double kLongestShortWave = 12.0;                         // m: longer ones are for the components alone
constexpr double kShortestWave = 0.017;  // m: here surface tension takes over from gravity, and slopes end
constexpr double kSpreadInLength = 0.2, kSpreadInDirection = 0.35;  // of a component's stand-ins: of ln k, rad

int wave_index(int texel) { return texel <= kSide / 2 ? texel : texel - kSide; }

/// Calls f(texel, k vector) for the wave numbers of a band.
template <class F>
void for_each_wave(const Band& band, double longest, F&& f) {
  const double step = kTwoPi / band.length, low = kTwoPi / longest, high = kTwoPi / band.shortest;
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) {
      if (u == kSide / 2 || v == kSide / 2) continue;
      const Eigen::Vector2d k = step * Eigen::Vector2d(wave_index(u), wave_index(v));
      const double size = k.norm();
      if (size >= low && size < high) f(static_cast<std::size_t>(v * kSide + u), k, size);
    }
}

double slope_variance(const MomentWave& wave) {
  return 0.5 * std::pow(static_cast<double>(wave.amplitude) * wave.wavenumber, 2);
}

/// Values that are close enough to give the same tiles have the same key.
std::vector<std::int32_t> key_of(std::span<const MomentWave> components, const Eigen::Vector2d& wind) {
  std::vector<std::int32_t> key = {static_cast<std::int32_t>(std::lround(4.0 * wind.x())),
                                   static_cast<std::int32_t>(std::lround(4.0 * wind.y()))};
  for (const MomentWave& wave : components) {
    const double size = std::abs(static_cast<double>(wave.amplitude)) + 1e-6;
    key.push_back(static_cast<std::int32_t>(std::lround(8.0 * std::log2(size))));
    key.push_back(static_cast<std::int32_t>(std::lround(1e4 * static_cast<double>(wave.turns_x))));
    key.push_back(static_cast<std::int32_t>(std::lround(1e4 * static_cast<double>(wave.turns_y))));
  }
  return key;
}

/// m; infinite where there is none.
double shortest_of(std::span<const MomentWave> components) {
  double number = 0.0;
  for (const MomentWave& wave : components)
    if (wave.amplitude != 0.0F) number = std::max(number, static_cast<double>(wave.wavenumber));
  return number > 0.0 ? kTwoPi / number : HUGE_VAL;
}

/// How white a place is: its crest broke, and the foam stays behind the crest and fades. `fold` turns backwards in
/// time, and has the angle 0 on a crest.
float foam_of(std::complex<float> fold, float breaks_at) {
  const float square = fold.real() * fold.real() + fold.imag() * fold.imag();
  if (square < breaks_at * breaks_at) return 0.0F;
  const float envelope = std::sqrt(square);
  float behind = 0.6F - std::arg(fold);  // the front of a breaker is a little ahead of its crest
  if (behind < 0.0F) behind += static_cast<float>(kTwoPi);
  const float breaking = std::min((envelope - breaks_at) / 0.6F, 1.0F), front = std::min(behind / 0.5F, 1.0F);
  return breaking * front * front * (3.0F - 2.0F * front) * std::exp(-0.7F * std::max(behind - 0.6F, 0.0F));
}

}  // namespace

double mean_square_slope(double wind) { return 0.003 + 0.00512 * std::clamp(wind, 0.0, 30.0); }

double whitecap_cover(double wind) { return 3.84e-6 * std::pow(std::clamp(wind, 0.0, 30.0), 3.41); }

double breaking_envelope(double wind) {
  // The envelope is Rayleigh distributed: P(envelope > x) = exp(-x^2 / 2). About a fifth of what breaks is white: the
  // trail fades and the pattern has holes.
  const double part = std::clamp(5.0 * whitecap_cover(wind), 1e-6, 0.45);
  return std::sqrt(-2.0 * std::log(part));
}

ShortWaves::ShortWaves(std::uint64_t seed) : fourier_(kSide), slopes_(kTexels), folds_(kTexels) {
  for (std::size_t t = 0; t < kShortWaveTiles; ++t) {
    tiles_[t].length = kBands[t].length;
    tiles_[t].texels.resize(kTexels);
    SplitMix64 random(seed + 0x5ea0 + t);
    random_[t].resize(kTexels);
    for (std::complex<float>& value : random_[t]) {  // Box and Muller (1958)
      const double radius = std::sqrt(-std::log(1.0 - random.next_unit())), angle = kTwoPi * random.next_unit();
      value = {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))};
    }
  }
}

void ShortWaves::set_sea(std::span<const MomentWave> components, const Eigen::Vector2d& wind) {
  std::vector<std::int32_t> key = key_of(components, wind);
  if (key == key_) return;
  key_ = std::move(key);
  double carried = 0.0;
  for (const MomentWave& wave : components) carried += slope_variance(wave);
  shortest_component_ = shortest_of(components);
  const double shortest = std::clamp(shortest_component_, 2.0 * kShortestWave, kLongestShortWave),
               total = mean_square_slope(wind.norm());
  // The equilibrium range has the same slope in each octave (Phillips 1958).
  const double rest = std::max(total - carried, 0.3 * total);
  const double per_octave = rest / std::log2(shortest / kShortestWave);
  whitecaps_ = breaking_envelope(wind.norm());
  for (std::size_t t = 0; t < kShortWaveTiles; ++t) {
    Power power(kTexels, 0.0);
    deposit(components, t, power);
    add_wind_sea(t, wind, per_octave, shortest, power);
    fill_cells(t, power);
  }
  variance_below_ = per_octave * std::log2(std::min(kBands.back().shortest, shortest) / kShortestWave);
}

void ShortWaves::deposit(std::span<const MomentWave> components, std::size_t tile, Power& power) const {
  struct Share {
    std::size_t at;
    double weight;
  };
  const Band& band = kBands[tile];
  std::vector<Share> shares;
  for (const MomentWave& wave : components) {
    const double number = static_cast<double>(wave.wavenumber);
    if (number < kTwoPi / band.longest || number >= kTwoPi / band.shortest) continue;
    shares.clear();
    double sum = 0.0;
    for_each_wave(band, band.longest, [&](std::size_t at, const Eigen::Vector2d& k, double size) {
      const double off = std::log(size / number) / kSpreadInLength;
      if (std::abs(off) > 3.0) return;
      const double cosine =
          (k.x() * static_cast<double>(wave.along_x) + k.y() * static_cast<double>(wave.along_y)) / size;
      const double turn = std::acos(std::clamp(cosine, -1.0, 1.0)) / kSpreadInDirection;
      if (turn > 3.0) return;
      shares.push_back({at, std::exp(-0.5 * (off * off + turn * turn)) / (size * size)});
      sum += shares.back().weight;
    });
    for (const Share& share : shares) power[share.at] += slope_variance(wave) * share.weight / sum;
  }
}

void ShortWaves::add_wind_sea(std::size_t tile, const Eigen::Vector2d& wind, double per_octave,
                              double shortest_component, Power& power) const {
  const Band& band = kBands[tile];
  const double longest = std::min(band.longest, shortest_component);
  if (longest <= band.shortest) return;
  const Eigen::Vector2d towards = wind.norm() > 0.1 ? Eigen::Vector2d(wind.normalized()) : Eigen::Vector2d::UnitX();
  double sum = 0.0;
  std::vector<std::pair<std::size_t, double>> shares;
  for_each_wave(band, longest, [&](std::size_t at, const Eigen::Vector2d& k, double size) {
    const double cosine = k.dot(towards) / size;
    // Shorter waves spread wider (Mitsuyasu and others 1975); the shortest run nearly all ways.
    const double spread = 0.08 + std::pow(std::max(0.5 + 0.5 * cosine, 0.0), kSpreading[tile]);
    shares.emplace_back(at, spread / (size * size));
    sum += shares.back().second;
  });
  const double variance = per_octave * std::log2(longest / band.shortest);
  for (const auto& [at, share] : shares) power[at] += variance * share / sum;
}

void ShortWaves::fill_cells(std::size_t tile, const Power& power) {
  cells_[tile].clear();
  double folding = 0.0;
  for_each_wave(kBands[tile], kBands[tile].longest, [&](std::size_t at, const Eigen::Vector2d& k, double size) {
    if (power[at] <= 0.0) return;
    const auto u = static_cast<int>(at) % kSide, v = static_cast<int>(at) / kSide;
    const int opposite = (kSide - v) % kSide * kSide + (kSide - u) % kSide;
    const auto amplitude = static_cast<float>(std::sqrt(2.0 * power[at]) / size);
    // surface tension: 0.074 N/m over 1025 kg/m^3
    const double omega = std::sqrt(kStandardGravity * size + 7.2e-5 * size * size * size);
    cells_[tile].push_back({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(opposite),
                            static_cast<float>(k.x()), static_cast<float>(k.y()), static_cast<float>(size), omega,
                            amplitude * random_[tile][at]});
    folding += power[at];
  });
  folding_[tile] = std::sqrt(folding);
}

void ShortWaves::evaluate(double time) {
  for (std::size_t t = 0; t < kShortWaveTiles; ++t) evaluate_tile(t, time);
}

void ShortWaves::evaluate_tile(std::size_t tile, double time) {
  const bool foams = tile != 2 && folding_[tile] > 0.0;
  std::fill(slopes_.begin(), slopes_.end(), 0.0F);
  std::fill(folds_.begin(), folds_.end(), 0.0F);
  for (const Cell& cell : cells_[tile]) {
    // Real numbers throughout: products of std::complex look for infinities, which takes most of the time here.
    const double turns = cell.omega / kTwoPi * time;
    const auto phase = static_cast<float>(-kTwoPi * (turns - static_cast<double>(static_cast<std::int64_t>(turns))));
    const float c = std::cos(phase), s = std::sin(phase);
    const float re = cell.height.real() * c - cell.height.imag() * s;
    const float im = cell.height.real() * s + cell.height.imag() * c;
    // The slopes along x and y have the spectra X = i kx h and Y = i ky h. Each is made symmetric, so that its sum is
    // real, and both are summed at once as X + i Y.
    const float x_re = 0.5F * cell.kx * re, x_im = 0.5F * cell.kx * im;
    const float y_re = 0.5F * cell.ky * re, y_im = 0.5F * cell.ky * im;
    slopes_[cell.index] += std::complex<float>(-x_im - y_re, x_re - y_im);
    slopes_[cell.opposite] += std::complex<float>(y_re - x_im, -x_re - y_im);
    if (foams) folds_[cell.index] += std::complex<float>(cell.number * re, cell.number * im);
  }
  fourier_.sum(slopes_);
  if (foams) fourier_.sum(folds_);
  const auto breaks_at = static_cast<float>(whitecaps_);
  const float scale = foams ? 1.0F / static_cast<float>(folding_[tile]) : 0.0F;
  for (std::size_t n = 0; n < kTexels; ++n) {
    const float x = slopes_[n].real(), y = slopes_[n].imag();
    const std::complex<float> fold(scale * folds_[n].real(), scale * folds_[n].imag());
    tiles_[tile].texels[n] = {x, y, x * x + y * y, foams ? foam_of(fold, breaks_at) : 0.0F};
  }
}

}  // namespace pelagos
