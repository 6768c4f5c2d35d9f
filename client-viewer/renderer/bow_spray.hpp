#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

#include "renderer/foam_map.hpp"

namespace pelagos {

/// A cluster of drops in the air.
struct SprayCluster {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< m, world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  double size = 0.5;                                   ///< m
  double strength = 1.0;                               ///< 0..1
};

/// Spray that bows throw up: a little at speed, much where a bow comes down on the water. It is thrown at whole
/// multiples of kTick of simulation time, by the hulls' motion there, with random numbers that follow from body and
/// instant. So viewers that show the same motion have the same drops. Appearance: the water of the simulation has no
/// part in it.
class BowSpray {
 public:
  static constexpr double kTick = 0.1;  ///< s
  static constexpr double kLife = 2.4;  ///< s

  /// Goes on to an instant; one that lies earlier, or more than two seconds later, starts anew: then hulls are assumed
  /// to have kept speed.
  void advance(double time, std::span<const MovingHull> hulls);

  /// What is in the air at an instant, at most kMost clusters; none has come down below the mean water level by more
  /// than a wave.
  /// @param level  m, world z of the mean water level   @param wind  m/s, towards
  [[nodiscard]] std::vector<SprayCluster> clusters(double time, double level, const Eigen::Vector2d& wind) const;
  static constexpr std::size_t kMost = 2000;

 private:
  struct Burst {
    std::int64_t tick = 0;
    MovingHull hull;
    double force = 0.0;  ///< 0..1
  };
  void throw_up(std::int64_t tick, const MovingHull& hull);

  std::deque<Burst> bursts_;
  std::map<std::uint32_t, MovingHull> last_;  ///< at the instant before, by body
  double shown_ = -1e9;                       ///< s
};

/// How hard a bow throws up water, 0..1. @param speed, slam  m/s, see MovingHull
[[nodiscard]] double bow_force(double speed, double slam);

}  // namespace pelagos
