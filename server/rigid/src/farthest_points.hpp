#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace pelagos {

/// Indices of points spread evenly over a cloud: starting with the first, always the one farthest from all chosen so
/// far, until none is farther than `least_distance`. So no two chosen are closer than that, and no point of the cloud
/// is farther than that from a chosen one. Ties go to the lower index.
[[nodiscard]] std::vector<std::size_t> select_farthest_points(std::span<const Eigen::Vector3d> points,
                                                              double least_distance);

}  // namespace pelagos
