#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "physics/fluid.hpp"
#include "physics/surface_grid.hpp"

namespace pelagos {

/// Where to look.
struct SurfacePlace {
  Eigen::Vector2d local = Eigen::Vector2d::Zero();  ///< m, x and y
  std::optional<double>
      height;  ///< m, local z: where the velocity is wanted, if it is under water; else at the surface
};

/// The water's surface at a place in the horizontal plane.
struct SurfaceReading {
  bool wet = false;                                    ///< false: no water there, and the rest means nothing
  double height = 0.0;                                 ///< m, local
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, out of the water
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, of the water there
  double share = 1.0;                                  ///< of the particles in this; the rest is the wave field's
};

/// A grid of cells of about `cell` over all particles with usable positions (finite, nearer than 1e9 m). Cells grow
/// where the particles are so far apart that there would be more than about a million.
[[nodiscard]] ColumnGrid make_column_grid(TaskPool& pool, std::span<const Float4> position, float cell);

/// Particles whose surface is measured. Spans must outlive what is made of them.
struct ColumnWater {
  std::span<const Float4> position, velocity;  ///< local; those of images behind those of particles
  std::size_t count = 0;                       ///< particles
  std::size_t first_image = 0, images = 0;
  double spacing = 1.0;  ///< m, d; each particle fills d^3

  static ColumnWater of(const FluidState& fluid);
};

/// Measures the surface by volume: around each place stands a column of water with soft sides (weight
/// (1 - r^2 / R^2)^2, R = 2 d), and what its particles above a level deep enough take up, V each, is the height of the
/// surface above that level. How full of water the column is (walls, hulls) comes from the slab of 2 d below it. So the
/// height has no bias from how particles happen to lie at the surface: still water reads its volume over its area,
/// where the highest particle plus d / 2 reads 0.3 d too high. Waves are smoothed by the column: by 0.3 % at a length
/// of 60 d, 2.5 % at 20 d. The normal comes from the column's first moments, the velocity is the mean of its
/// topmost 1.5 d, or within 2 d of a place under water. Where the water is less than 4 d deep the column below the
/// surface is taken as it is. Lone drops are not surface: a column's top has water below it.
///
/// Particles are put into cells 2 d wide once, in one pass that finds their cells and one that copies them; then a
/// place costs what is in the 3 x 3 cells around it, and answers do not depend on what else is asked, nor on the number
/// of threads.
class WaterColumns {
 public:
  /// Nothing is wet before `build`.
  WaterColumns() = default;
  WaterColumns(TaskPool& pool, const ColumnWater& water) { build(pool, water); }

  /// Takes the particles as they are now; memory is used again.
  void build(TaskPool& pool, const ColumnWater& water);

  [[nodiscard]] SurfaceReading read(const SurfacePlace& place) const;

  /// The heights at the centres of a grid of 2 d over all particles; velocities are left zero.
  void sample(TaskPool& pool, SurfaceGrid& surface) const;
  /// Adds the velocities to a grid that `sample` has made.
  void add_velocities(TaskPool& pool, SurfaceGrid& surface) const;

 private:
  void use_grid(const ColumnGrid& grid);
  /// Of the n-th particle or image.
  [[nodiscard]] std::size_t index_of(std::size_t n) const {
    return n < water_.count ? n : n - water_.count + water_.first_image;
  }
  /// One pass over all particles: their bins, how many are in each, and the grid that covers them.
  [[nodiscard]] ColumnGrid count_in_bins(TaskPool& pool, float cell);
  void sort_into_bins(TaskPool& pool);
  [[nodiscard]] std::size_t bin_of(double x, double y) const;
  /// Ranges of sorted particles: three rows of three bins around a bin.
  using Ranges = std::array<std::pair<std::uint32_t, std::uint32_t>, 3>;
  [[nodiscard]] Ranges ranges_about(std::size_t bin) const;
  [[nodiscard]] SurfaceReading read_in(const Ranges& ranges, const Eigen::Vector2d& at) const;
  /// Over the topmost 1.5 d.
  [[nodiscard]] Eigen::Vector3d mean_velocity(const Ranges& ranges, const Eigen::Vector2d& at, double surface) const;
  [[nodiscard]] Eigen::Vector3d velocity_near(const Ranges& ranges, const Eigen::Vector3d& at) const;

  ColumnWater water_;
  ColumnGrid grid_;                        ///< over the particles
  ColumnGrid bins_;                        ///< the same with a cell more on every side, for images
  std::vector<std::uint32_t> begin_;       ///< [bins + 1] of the particles of each bin
  std::vector<float> x_, y_, z_;           ///< m, of the particles, bin by bin
  std::vector<std::uint32_t> bin_, next_;  ///< scratch of the sort
  std::vector<std::uint32_t> particle_;    ///< which they are
};

}  // namespace pelagos
