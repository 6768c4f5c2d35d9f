#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "oil/slick_layer.hpp"

namespace pelagos {

/// Surroundings that follow from the place by a function; still water and no wind without one.
class PlacedSurroundings : public SlickSurroundings {
 public:
  PlacedSurroundings() = default;
  explicit PlacedSurroundings(std::function<SurfaceState(const Eigen::Vector2d&)> state) : state_(std::move(state)) {}
  explicit PlacedSurroundings(const SurfaceState& everywhere)
      : state_([everywhere](const Eigen::Vector2d&) { return everywhere; }) {}

  void sample(std::span<const Eigen::Vector2d> positions, std::span<SurfaceState> states) const override {
    for (std::size_t i = 0; state_ && i < positions.size(); ++i) states[i] = state_(positions[i]);
  }

 private:
  std::function<SurfaceState(const Eigen::Vector2d&)> state_;
};

inline SurfaceState moving(const Eigen::Vector2d& water, const Eigen::Vector2d& wind = {0.0, 0.0}) {
  SurfaceState state;
  state.water_velocity = water;
  state.wind = wind;
  return state;
}

/// Of a refusal; empty where there is none.
inline std::string text_of(const std::optional<Refusal>& refusal) { return refusal ? to_string(*refusal) : ""; }

/// Neither weathers nor splits: the mechanics alone.
inline SlickSettings plain_settings() {
  SlickSettings settings;
  settings.evaporation = settings.emulsification = false;
  settings.largest_radius = 1e6;
  return settings;
}

inline double reduced_gravity(const SlickSettings& s) {
  return s.gravity * (s.water_density - s.oil.density) / s.water_density;
}

/// Fay's radii of a round slick of volume V at time t (Fay 1969, 1971).
inline double fay_inertial(const SlickSettings& s, double volume, double time) {
  return 1.14 * std::pow(reduced_gravity(s) * volume * time * time, 0.25);
}
inline double fay_viscous(const SlickSettings& s, double volume, double time) {
  return 1.45 *
         std::pow(reduced_gravity(s) * volume * volume * std::pow(time, 1.5) / std::sqrt(s.water_viscosity), 1.0 / 6.0);
}
inline double fay_area(const SlickSettings& s, double volume, double time) {
  const double radius = std::min(fay_inertial(s, volume, time), fay_viscous(s, volume, time));
  return std::numbers::pi * radius * radius;
}

/// A disc of oil made of `count` elements on a sunflower's spiral.
inline void release_disc(SlickLayer& layer, double mass, const Eigen::Vector2d& centre, double radius,
                         std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double n = static_cast<double>(count), k = static_cast<double>(i);
    const double r = count == 1 ? 0.0 : radius * std::sqrt((k + 0.5) / n) * (1.0 - 0.5 / std::sqrt(n));
    const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const auto refusal =
        layer.release(mass / n, centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)), radius / std::sqrt(n));
    if (refusal) throw std::logic_error(to_string(*refusal));
  }
}

inline void run(SlickLayer& layer, const SlickSurroundings& surroundings, double seconds, double dt) {
  for (int step = 0; step < static_cast<int>(std::lround(seconds / dt)); ++step) layer.advance(dt, surroundings);
}

inline Eigen::Vector2d centre_of_mass(const SlickLayer& layer) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double mass = 0.0;
  for (const SlickElement& e : layer.elements()) {
    sum += static_cast<double>(e.mass) * e.position;
    mass += static_cast<double>(e.mass);
  }
  return sum / mass;
}

}  // namespace pelagos
