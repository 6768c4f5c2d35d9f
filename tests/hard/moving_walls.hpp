#pragma once

#include "hard_water.hpp"

namespace pelagos::hard {

/// What moving walls did to water.
struct WallOutcome {
  Outcome water;
  std::size_t leaked = 0;    ///< particles on the wrong side, most at any step
  double angular_speed = 0;  ///< rad/s of the water about the axis, at the end (rotating tank)
};

/// A square bucket, open above, that turns about z at `speed` rad/s with water in it.
[[nodiscard]] WallOutcome rotate_bucket(const std::string& solver, double speed, int turns_percent);

/// How the piston's steps are chosen.
enum class PistonSteps {
  kFixed,     ///< always dt = 0.07 sqrt(d/g)
  kAdaptive,  ///< at most that, and no wall or water moves more than 0.4 d in a step
};

/// A wall across a channel that pushes into the water at U = reach d / (0.07 sqrt(d/g)).
[[nodiscard]] WallOutcome push_piston(const std::string& solver, double reach, PistonSteps steps);

}  // namespace pelagos::hard
