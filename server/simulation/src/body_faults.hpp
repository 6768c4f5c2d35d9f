#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "simulation/placed_shape.hpp"

namespace pelagos {

/// Whether a sample is where the water's support may reach: in the patch or not farther than a support radius from it.
[[nodiscard]] bool is_within_reach(const Box& patch, const Eigen::Vector3d& world, double support_radius);

/// What is wrong with the bodies of a scene, one line each, which begins with the body: faults of the mesh; a body
/// outside the patch (one that moves: and not beyond an open edge), nearer than a support radius to a periodic face, or
/// inside another one; an open mesh whose rim stands in water. STATIC bodies may stand in one another (a tower on a
/// rock), but none altogether.
[[nodiscard]] std::vector<std::string> body_faults(const Scene& scene, double support_radius,
                                                   std::span<const PlacedShape> bodies);

}  // namespace pelagos
