#include "wind/air.hpp"

#include <algorithm>
#include <cmath>

#include "waves/splitmix.hpp"
#include "wind/perlin_noise.hpp"

namespace pelagos {

namespace {

/// Integral over [0, tau] of (u0 + du s) / (l0 + dl s).
Eigen::Vector3d integrate_ratio(const Eigen::Vector3d& u0, const Eigen::Vector3d& du, double l0, double dl,
                                double tau) {
  if (std::abs(dl) * tau < 1e-6 * l0) return (u0 * tau + du * (0.5 * tau * tau)) / (l0 + 0.5 * dl * tau);
  const double growth = std::log1p(dl * tau / l0) / dl;
  return du * (tau / dl) + (u0 - du * (l0 / dl)) * growth;
}

Eigen::Vector3d random_offset(SplitMix64& random) {
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis) offset[axis] = 256.0 * random.next_unit();
  return offset;
}

}  // namespace

double log_profile(double height, double roughness) {
  return height > roughness ? std::log(height / roughness) / std::log(Air::kReferenceHeight / roughness) : 0.0;
}

Air::Air(const AirSurroundings& around, const WindSettings& wind, double time)
    : around_(around), from_(wind), to_(wind), ramp_start_(time) {
  SplitMix64 random(around.seed);
  for (Eigen::Vector3d& offset : offset_) offset = random_offset(random);
}

void Air::set(const WindSettings& wind, double time, double ramp_seconds) {
  const Blend present = blend_at(time);
  carried_ = carried_at(time);
  from_ = present.wind;
  from_pulse_ = present.pulse;
  to_ = wind;
  ramp_start_ = time;
  ramp_seconds_ = std::max(ramp_seconds, 0.0);
}

double Air::pulse_at(const WindSettings& wind, double time) const {
  if (!wind.pulse) return 1.0;
  const double clock = wind.law == WindLaw::kPaper ? static_cast<double>(steps_) : time;
  const double phase = clock - wind.pulse->period * std::floor(clock / wind.pulse->period);
  return phase < wind.pulse->width ? 1.0 : 0.0;
}

Air::Blend Air::blend_at(double time) const {
  const double since = time - ramp_start_;
  const double part = since < ramp_seconds_ ? std::max(since, 0.0) / ramp_seconds_ : 1.0;
  const double pulse = pulse_at(to_, time);
  if (part >= 1.0) return {pulse, to_};
  Blend blend{from_pulse_ + part * (pulse - from_pulse_), to_};
  blend.wind.velocity = from_.velocity + part * (to_.velocity - from_.velocity);
  blend.wind.amplitude = from_.amplitude + part * (to_.amplitude - from_.amplitude);
  blend.wind.length = from_.length + part * (to_.length - from_.length);
  blend.wind.beta = from_.beta + part * (to_.beta - from_.beta);
  return blend;
}

Eigen::Vector3d Air::carried_at(double time) const {
  const double since = std::max(time - ramp_start_, 0.0);
  const double ramped = std::min(since, ramp_seconds_);
  Eigen::Vector3d carried = carried_ + to_.velocity * ((since - ramped) / to_.length);
  if (ramped > 0.0)
    carried += integrate_ratio(from_.velocity, (to_.velocity - from_.velocity) / ramp_seconds_, from_.length,
                               (to_.length - from_.length) / ramp_seconds_, ramped);
  return carried;
}

Eigen::Vector3d Air::jump_of_step() const {
  SplitMix64 random(around_.seed ^ (0x9e3779b97f4a7c15u * (steps_ + 1)));
  return random_offset(random);
}

Air::Moment Air::at(double time) const {
  Moment moment;
  const Blend blend = blend_at(time);
  moment.pulse = blend.pulse;
  moment.wind = blend.wind;
  moment.offset = to_.law == WindLaw::kPaper ? jump_of_step() : Eigen::Vector3d(-carried_at(time));
  return moment;
}

Eigen::Vector3d Air::reference(const Moment& moment, const Eigen::Vector3d& local) const {
  if (moment.wind.amplitude == 0.0) return moment.pulse * moment.wind.velocity;
  const Eigen::Vector3d s = (local + around_.way) / moment.wind.length + moment.offset;
  Eigen::Vector3d noise;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d p = s + offset_[static_cast<std::size_t>(axis)];
    noise[axis] = perlin_noise(p.x(), p.y(), p.z());
  }
  return moment.pulse * (moment.wind.velocity + moment.wind.amplitude * noise);
}

Eigen::Vector3d Air::velocity_at(const Eigen::Vector3d& position, double time) const {
  const Moment moment = at(time);
  const double profile = log_profile(position.z() - around_.water_level, moment.wind.roughness);
  if (profile == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d local = around_.frame.to_local(position);
  return profile * reference(moment, {local.x(), local.y(), local_level()});
}

}  // namespace pelagos
