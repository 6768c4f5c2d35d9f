#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "physics/solid_field.hpp"
#include "physics/task_pool.hpp"
#include "rigid/body_shape.hpp"

namespace pelagos {

/// Share of a body's surface, 0 to 1, behind which it is thinner than `least` (m).
[[nodiscard]] double thin_share(const BodyShape& shape, double least);

/// Where distance fields are wanted.
struct FieldExtent {
  double spacing = 0.0;        ///< m, of particles, > 0; nodes are half as far apart
  double reach = 0.0;          ///< m, from the surface; distances farther away are not told apart
  Eigen::AlignedBox3d within;  ///< m, body axes: nodes outside are left out

  [[nodiscard]] double cell() const { return 0.5 * spacing; }
};

/// The distance fields of a body's surface: one for each of its smooth_patches. Empty if they would have more than
/// kMostFieldNodes nodes together.
[[nodiscard]] std::vector<std::shared_ptr<const SolidField>> make_distance_fields(TaskPool& pool,
                                                                                  const BodyShape& shape,
                                                                                  const FieldExtent& extent);

/// 16 bytes each.
inline constexpr double kMostFieldNodes = 16e6;

}  // namespace pelagos
