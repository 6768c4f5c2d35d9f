#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

namespace pelagos {

/// What the slick meets at one place of the surface.
struct SurfaceState {
  Eigen::Vector2d water_velocity = Eigen::Vector2d::Zero();  ///< m/s, of the water at the surface
  Eigen::Vector2d wind = Eigen::Vector2d::Zero();            ///< m/s, at 10 m; the direction the air moves towards
  double height = 0.0;                                       ///< m, world, of the surface
  bool water = true;                                         ///< false: dry; oil lies where it is until water comes
  bool waves_carry = false;  ///< the water velocity holds waves that the wind raised, and their drift
  bool covered = false;      ///< a hull or a wall lies over the place; oil is moved by way_out
  Eigen::Vector2d way_out = Eigen::Vector2d::Zero();  ///< m, shortest way from the place to open water
  /// m: no hull or wall is met on a way so long. Oil that goes farther asks `go`.
  double room = std::numeric_limits<double>::infinity();
};

/// The slick's window on the rest of the world; implemented by whoever composes the layers.
class SlickSurroundings {
 public:
  virtual ~SlickSurroundings() = default;

  /// Fills states[i] for the place positions[i] (m, world). Called once a step, before anything moves. Values that are
  /// not finite are allowed: the element keeps its place for the step and is counted.
  virtual void sample(std::span<const Eigen::Vector2d> positions, std::span<SurfaceState> states) const = 0;

  /// Where oil ends that would go from a place that is not covered to another (m, world): hulls and walls stop it, and
  /// it keeps the part of its way along them. May be called at any time between two calls of `sample`.
  /// @param state  of the first place
  [[nodiscard]] virtual Eigen::Vector2d go(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                           const SurfaceState& state) const {
    static_cast<void>(from);
    static_cast<void>(state);
    return to;
  }
};

}  // namespace pelagos
