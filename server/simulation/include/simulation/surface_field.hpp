#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "physics/fluid.hpp"
#include "wind/column_grid.hpp"

namespace pelagos {

/// Height and velocity of the water's surface over the horizontal plane, out of the particles at one instant.
/// Cells are 2 d wide; a cell's surface is its highest particle plus d/2, flying drops left out, and its velocity the
/// mean of the particles within a spacing below that. Between cell centres values are linear.
class SurfaceField {
 public:
  /// Local coordinates. Costs two passes over the particles.
  void build(const FluidState& fluid, double fallback_level);

  struct Sample {
    double height = 0.0;                                 ///< m, local
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  };
  /// Nothing where there is no water within a cell.
  [[nodiscard]] std::optional<Sample> at(const Eigen::Vector2d& local) const;
  /// m/s, mean over the particles near the surface; 0 where there are none.
  [[nodiscard]] Eigen::Vector3d mean_velocity() const;

 private:
  struct Cell {
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    float surface = 0.0F;  ///< m, local
    int count = 0;         ///< particles near the surface; 0: dry
  };
  void measure_velocities(const FluidState& fluid);

  ColumnGrid grid_;
  std::vector<float> highest_;
  std::vector<Cell> cells_;
};

}  // namespace pelagos
