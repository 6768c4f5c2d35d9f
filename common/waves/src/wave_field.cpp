#include "waves/wave_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace pelagos {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kDeepNumber = 16.0;  ///< k h above which e^(-k h) is lost in single precision

/// A share and its rate, 1/s.
struct Share {
  double value = 1.0, rate = 0.0;
};

Share share_of(const WaveLayer& layer, double time) {
  const double since = time - layer.start;
  if (since >= layer.seconds || !(layer.seconds > 0.0)) return {since >= 0.0 ? 1.0 : 0.0, 0.0};
  if (since <= 0.0) return {0.0, 0.0};
  const double q = since / layer.seconds;
  return {q * q * q * (10.0 + q * (6.0 * q - 15.0)), 30.0 * q * q * (1.0 - q) * (1.0 - q) / layer.seconds};
}

MomentWave moment_wave(const WaveComponent& component, const Share& share, double depth, double time,
                       const Eigen::Vector2d& anchor) {
  const double k = component.wavenumber, direction = component.direction;
  const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
  const double turns =
      (k * along.dot(anchor) - static_cast<double>(component.omega) * time + static_cast<double>(component.phase)) /
      kTurn;
  const double echo = k * depth < kDeepNumber ? std::exp(-2.0 * k * depth) : 0.0;
  MomentWave wave;
  wave.amplitude = static_cast<float>(share.value * static_cast<double>(component.amplitude));
  wave.amplitude_rate = static_cast<float>(share.rate * static_cast<double>(component.amplitude));
  wave.along_x = static_cast<float>(along.x());
  wave.along_y = static_cast<float>(along.y());
  wave.turns_x = static_cast<float>(k * along.x() / kTurn);
  wave.turns_y = static_cast<float>(k * along.y() / kTurn);
  wave.phase = static_cast<float>(turns - std::round(turns));
  wave.wavenumber = component.wavenumber;
  wave.omega = component.omega;
  wave.echo = static_cast<float>(echo);
  wave.bed = static_cast<float>(1.0 / (1.0 - echo));
  return wave;
}

}  // namespace

double WaveLayer::share_at(double time) const { return share_of(*this, time).value; }

WaveField::WaveField(std::vector<WaveComponent> components, double level, double depth)
    : layers_{WaveLayer{std::move(components), 0.0, 0.0}}, level_(level), depth_(depth) {}

WaveField WaveField::of_layers(std::vector<WaveLayer> layers, double level, double depth) {
  WaveField field({}, level, depth);
  field.layers_ = std::move(layers);
  assert(field.sound());
  return field;
}

bool WaveField::exchange(std::vector<WaveComponent> components, double time, double seconds) {
  std::size_t first = layers_.size() - 1;  // that counts: the newest one that is there in full
  while (first > 0 && share_of(layers_[first], time).value < 1.0) --first;
  if (layers_.size() - first >= kMostLayers) {
    if (seconds > 0.0) return false;
    first = layers_.size() - 1;  // at once: what still blends has no share from `time` on
  }
  layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(first));
  layers_.push_back({std::move(components), time, seconds});
  return true;
}

double WaveField::open_from() const {
  if (layers_.size() < kMostLayers) return layers_.back().start;
  double first_end = layers_[1].start + layers_[1].seconds;
  for (const WaveLayer& layer : layers().subspan(1)) first_end = std::min(first_end, layer.start + layer.seconds);
  return first_end;
}

WaveMoment WaveField::at(double time, const Eigen::Vector2d& anchor) const {
  WaveMoment moment{time, anchor, level_, depth_, {}};
  Share left;  // of what newer layers leave
  for (std::size_t i = layers_.size(); i-- > 0 && (left.value > 0.0 || left.rate != 0.0);) {
    Share own = share_of(layers_[i], time);
    if (i == 0) own = {};
    const Share share{own.value * left.value, own.rate * left.value + own.value * left.rate};
    for (const WaveComponent& component : layers_[i].components)
      if (share.value > 0.0) moment.waves.push_back(moment_wave(component, share, depth_, time, anchor));
    left = {(1.0 - own.value) * left.value, (1.0 - own.value) * left.rate - own.rate * left.value};
  }
  return moment;
}

}  // namespace pelagos
