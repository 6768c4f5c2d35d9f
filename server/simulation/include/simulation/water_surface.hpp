#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "physics/fluid.hpp"
#include "simulation/surface_blend.hpp"
#include "surface/water_columns.hpp"

namespace pelagos {

/// The one surface of the water: the particles' inside the patch, the wave field's outside, blended once. Probes, wind,
/// oil, loads and drift ask it. What it needs of the particles (WaterColumns, their grid) is made when the first one
/// asks after a step, and kept until the particles move; who does not ask pays nothing. For one thread at a time.
class WaterSurface {
 public:
  /// @param pool  must outlive this
  WaterSurface(TaskPool& pool, const SurfaceSurroundings& around) : pool_(pool), around_(around) {}

  /// The patch has moved.
  void follow(const PatchFrame& frame) {
    around_.frame = frame;
    forget();
  }
  /// The particles have moved, or will have before the next question.
  void forget() { has_columns_ = has_grid_ = has_velocities_ = false; }

  /// The particles' surface on a grid of 2 d: what particles themselves ask, all over the patch. At cell centres it is
  /// what `read` says there. Velocities are there if they have been asked for since the particles moved.
  [[nodiscard]] const SurfaceGrid& grid(const FluidState& fluid);
  [[nodiscard]] const SurfaceGrid& grid_with_velocities(const FluidState& fluid);

  /// The surface at places, by the particles' columns and the wave field at `time`. A place that is dry by the
  /// particles is dry where they alone count; outside the patch there is always water.
  [[nodiscard]] std::vector<SurfaceReading> read(const FluidState& fluid, const WaveField& sea, double time,
                                                 std::span<const SurfacePlace> places);

  /// The particles' part alone: inside the patch, dry outside.
  [[nodiscard]] std::vector<SurfaceReading> read_particles(const FluidState& fluid,
                                                           std::span<const SurfacePlace> places);
  /// The same, but only where the particles have a share; dry, and free of charge, elsewhere.
  [[nodiscard]] std::vector<SurfaceReading> read_shared(const FluidState& fluid, std::span<const SurfacePlace> places);

  [[nodiscard]] const SurfaceSurroundings& around() const { return around_; }

 private:
  [[nodiscard]] const WaterColumns& columns(const FluidState& fluid);

  TaskPool& pool_;
  SurfaceSurroundings around_;
  WaterColumns columns_;
  SurfaceGrid grid_;
  bool has_columns_ = false, has_grid_ = false, has_velocities_ = false;  ///< of the particles as they are
};

/// The surface of a grid at a place, linear between the centres of wet cells; beyond the outermost centres their values
/// hold for a cell.
struct GridSample {
  double height = 0.0;                                 ///< m, local
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
};
/// Nothing where there is no water within a cell.
[[nodiscard]] std::optional<GridSample> sample_at(const SurfaceGrid& surface, const Eigen::Vector2d& local);
/// m/s, mean over the wet cells; 0 where there are none.
[[nodiscard]] Eigen::Vector3d mean_velocity(const SurfaceGrid& surface);

}  // namespace pelagos
