#pragma once

#include <Eigen/Core>

namespace pelagos {

/// Which motions of a body answer what pushes it: 1, or 0 for those that do not. World axes.
struct Freedoms {
  Eigen::Vector3d along = Eigen::Vector3d::Ones();  ///< x, y, z
  Eigen::Vector3d about = Eigen::Vector3d::Ones();

  [[nodiscard]] static Freedoms heave_roll_pitch() { return {{0.0, 0.0, 1.0}, {1.0, 1.0, 0.0}}; }
  [[nodiscard]] bool turns_freely() const { return about.minCoeff() > 0.0; }
  [[nodiscard]] bool all() const { return along.minCoeff() > 0.0 && turns_freely(); }

  /// @param motion  along x, y, z, then about them
  [[nodiscard]] bool has(int motion) const { return (motion < 3 ? along[motion] : about[motion - 3]) > 0.0; }
};

}  // namespace pelagos
