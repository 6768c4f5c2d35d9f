#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace pelagos {

/// Indices of a maximal Poisson-disk set out of a dense cloud: no two chosen are closer than `least_distance`, no point
/// of the cloud is that far from all of them. Dart throwing: the points come in a random order, and one is taken unless
/// a taken one is too near. So do Bowers et al. (2010, "Parallel Poisson disk sampling with spectrum analysis on
/// surfaces"), who throw from many cells at once; here one after another in a fixed order, so that the same cloud gives
/// the same set.
/// @param sides  of each point: points whose sides are opposed (are_opposed) need no distance from each other
[[nodiscard]] std::vector<std::size_t> select_poisson_disk(std::span<const Eigen::Vector3d> points,
                                                           std::span<const Eigen::Vector3d> sides,
                                                           double least_distance);

}  // namespace pelagos
