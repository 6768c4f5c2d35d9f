#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scales/angles.hpp"

namespace pelagos {

/// How a current falls with depth (DNV-RP-C205, 2010, section 4.1.4: wind-driven currents fall linearly, tidal ones by
/// a power law with exponent 1/7).
enum class CurrentShear : std::uint8_t {
  kNone,          ///< the same at every depth
  kLinear,        ///< 1 - z / depth
  kSeventhPower,  ///< (1 - z / depth)^(1/7)
};

struct CurrentSettings {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, at the surface, TOWARDS; z is 0
  CurrentShear shear = CurrentShear::kNone;
  double depth = 0.0;       ///< m under the mean level where it is zero, > 0; of no meaning without shear
  double relaxation = 5.0;  ///< s, > 0: in which the mean velocity of water comes to within 1/e of it

  /// Part of the surface's velocity at a depth z (m, counted down from the mean level); 1 above that level.
  [[nodiscard]] double profile(double z) const {
    if (shear == CurrentShear::kNone) return 1.0;
    const double part = std::clamp(1.0 - z / depth, 0.0, 1.0);
    return shear == CurrentShear::kLinear ? part : std::pow(part, 1.0 / 7.0);
  }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("velocity", self.velocity);
    visit("shear", self.shear);
    visit("depth", self.depth);
    visit("relaxation", self.relaxation);
  }
};

/// Degrees clockwise from north that a current sets TOWARDS; and back.
[[nodiscard]] inline double current_to_deg(const Eigen::Vector3d& velocity) {
  const double degrees = std::atan2(velocity.x(), velocity.y()) * kDegreesPerRadian;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}
[[nodiscard]] inline Eigen::Vector3d current_velocity(double speed, double to_deg) {
  return {speed * std::sin(to_deg * kRadiansPerDegree), speed * std::cos(to_deg * kRadiansPerDegree), 0.0};
}

/// A current over the whole sea, ramps included: a value to be copied and asked anywhere. Times are simulated seconds.
class Current {
 public:
  Current() = default;  ///< to be read into
  /// No current yet.
  /// @param water_level  m, world: the mean level, from which depths count
  /// @param moves_water  for x, y: whether the water of the patch itself moves with it (periodic axes)
  Current(double water_level, const std::array<bool, 2>& moves_water)
      : water_level_(water_level), moves_water_(moves_water) {}

  /// The velocity at the surface changes from that at `time` linearly over `ramp_seconds` (0: at once); shear, depth
  /// and relaxation hold at once.
  void set(const CurrentSettings& settings, double time, double ramp_seconds) {
    from_ = surface_velocity_at(time);
    to_ = settings;
    ramp_start_ = time;
    ramp_seconds_ = std::max(ramp_seconds, 0.0);
  }

  /// The settings as they are at `time`, mid-ramp velocity included.
  [[nodiscard]] CurrentSettings settings_at(double time) const {
    CurrentSettings settings = to_;
    settings.velocity = surface_velocity_at(time);
    return settings;
  }

  /// m/s at `position` (m, world).
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& position, double time) const {
    return to_.profile(water_level_ - position.z()) * surface_velocity_at(time);
  }

  /// The part of it that the water of the patch does not make itself. What drifts with the velocity of the water around
  /// it adds this.
  [[nodiscard]] Eigen::Vector3d unresolved_velocity_at(const Eigen::Vector3d& position, double time) const {
    Eigen::Vector3d velocity = velocity_at(position, time);
    for (int axis = 0; axis < 2; ++axis)
      if (moves_water_[static_cast<std::size_t>(axis)]) velocity[axis] = 0.0;
    return velocity;
  }

  /// m/s, and its rate of change by the ramp, m/s^2.
  [[nodiscard]] Eigen::Vector3d surface_velocity_at(double time) const {
    const double since = time - ramp_start_;
    if (since >= ramp_seconds_) return to_.velocity;
    return from_ + std::max(since, 0.0) / ramp_seconds_ * (to_.velocity - from_);
  }
  [[nodiscard]] Eigen::Vector3d surface_rate_at(double time) const {
    if (time - ramp_start_ >= ramp_seconds_) return Eigen::Vector3d::Zero();
    return (to_.velocity - from_) / ramp_seconds_;
  }

  [[nodiscard]] const CurrentSettings& target() const { return to_; }
  [[nodiscard]] const std::array<bool, 2>& moves_water() const { return moves_water_; }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("water_level", self.water_level_);
    visit("moves_water", self.moves_water_);
    visit("from", self.from_);
    visit("to", self.to_);
    visit("ramp_start", self.ramp_start_);
    visit("ramp_seconds", self.ramp_seconds_);
  }

 private:
  double water_level_ = 0.0;
  std::array<bool, 2> moves_water_{false, false};
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  CurrentSettings to_;
  double ramp_start_ = 0.0, ramp_seconds_ = 0.0;
};

}  // namespace pelagos
