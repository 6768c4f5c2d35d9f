#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "values/patch_frame.hpp"
#include "values/wind.hpp"

namespace pelagos {

/// What the air blows over.
struct AirSurroundings {
  PatchFrame frame;          ///< heights of WindLaw::kPaper count from its floor
  double water_level = 0.0;  ///< m, world: mean level, from which heights count
  std::uint64_t seed = 1;    ///< of the disturbance
  /// m: how far the frame has moved since the start. The disturbance stays where it is in the world.
  Eigen::Vector3d way = Eigen::Vector3d::Zero();

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("frame", self.frame);
    visit("water_level", self.water_level);
    visit("seed", self.seed);
    visit("way", self.way);
  }
};

/// The velocity of the air over the sea: a value that may be copied and asked on any thread. At 10 m it is
///   v10 = g(t) [U + A noise(s)] ,   s = x / l - integral of U / l dt   ( = (x - U t) / l in a constant wind)
/// with g(t) the pulse (1 in its width, else 0) and three independent noises (Perlin 2002) for the components, offset
/// by the seed. After Li et al.'s stochastic fluctuating wind (paper eq. 31, 32, 35), whose disturbance is white noise
/// in time: here the mean wind carries it (frozen turbulence). Gusts are upright: the noise is taken at the mean level
/// whatever the height. At height z above the mean level
///   v(z) = v10 ln(z / z0) / ln(10 m / z0) ,   0 for z <= z0 .
///
/// The disturbance has a standard deviation of about 0.27 A a component, and repeats after 256 l.
///
/// With WindLaw::kPaper the disturbance is new in every step, as the paper has it, and the pulse counts steps.
class Air {
 public:
  Air() = default;  ///< calm; to be read into
  /// @param wind  blows at once
  /// @param time  s, simulation time; the disturbance starts unshifted at this time
  Air(const AirSurroundings& around, const WindSettings& wind, double time = 0.0);

  /// From the wind that blows at `time` linearly to `wind` over `ramp_seconds` (<= 0: at once): velocity, amplitude,
  /// length, control factor and the value of the pulse; law and roughness change at once. Velocity and disturbance stay
  /// continuous, also when a ramp is replaced before its end. Times must not decrease from call to call.
  void set(const WindSettings& wind, double time, double ramp_seconds);

  /// The patch has moved: what is local from now on is so in this frame.
  void follow(const PatchFrame& frame) {
    around_.way += frame.way_from(around_.frame);
    around_.frame = frame;
  }

  /// A time step has been made: moves the paper's pulse and noise on. Nothing else depends on it.
  void count_step() { ++steps_; }

  /// The settings that were last set, where a ramp ends.
  [[nodiscard]] const WindSettings& target() const { return to_; }
  /// The settings as they are at `time`, mid-ramp values included.
  [[nodiscard]] WindSettings settings_at(double time) const { return at(time).wind; }

  /// Velocity of the air, m/s: what an anemometer at `position` (m, world) reads.
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& position, double time) const;

  /// What many places have in common at one time.
  struct Moment {
    double pulse = 1.0;      ///< 0..1
    WindSettings wind;       ///< mid-ramp values included
    Eigen::Vector3d offset;  ///< of the noise's argument: minus the way that the wind has carried it, in eddy lengths
  };
  [[nodiscard]] Moment at(double time) const;

  /// v10 at a place, local coordinates. The laws gust and stress take it at the mean level.
  [[nodiscard]] Eigen::Vector3d reference(const Moment& moment, const Eigen::Vector3d& local) const;

  /// The mean level in local coordinates, m.
  [[nodiscard]] double local_level() const { return around_.frame.local_height(around_.water_level); }
  [[nodiscard]] double local_floor() const { return around_.frame.local_height(around_.frame.box.min.z()); }

  static constexpr double kReferenceHeight = 10.0;  ///< m (paper eq. 34)
  static constexpr double kDensity = 1.293;         ///< kg/m^3 (paper eq. 33)

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("around", self.around_);
    visit("offset", self.offset_);
    visit("from", self.from_);
    visit("to", self.to_);
    visit("from_pulse", self.from_pulse_);
    visit("ramp_start", self.ramp_start_);
    visit("ramp_seconds", self.ramp_seconds_);
    visit("carried", self.carried_);
    visit("steps", self.steps_);
  }

 private:
  struct Blend {
    double pulse;
    WindSettings wind;
  };
  [[nodiscard]] Blend blend_at(double time) const;
  /// Integral of U / l from the start of the ramp to `time`, added to what was carried before.
  [[nodiscard]] Eigen::Vector3d carried_at(double time) const;
  /// The paper's seed is the time in milliseconds: a jump of the noise's argument from step to step.
  [[nodiscard]] Eigen::Vector3d jump_of_step() const;
  [[nodiscard]] double pulse_at(const WindSettings& wind, double time) const;

  AirSurroundings around_;
  std::array<Eigen::Vector3d, 3> offset_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Zero()};  ///< of the noise of each component
  WindSettings from_, to_;
  double from_pulse_ = 1.0;  ///< value of the pulse when the ramp began
  double ramp_start_ = 0.0, ramp_seconds_ = 0.0;
  Eigen::Vector3d carried_ = Eigen::Vector3d::Zero();  ///< at the ramp's start, in eddy lengths
  std::uint64_t steps_ = 0;
};

/// ln(z / z0) / ln(10 m / z0), 0 for z <= z0: the neutral log profile over a surface of roughness z0, 0 < z0 < 10 m.
[[nodiscard]] double log_profile(double height, double roughness);

}  // namespace pelagos
