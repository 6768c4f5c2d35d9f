#pragma once

#include <Eigen/Core>
#include <span>

#include "simulation/placed_shape.hpp"
#include "text/refusal.hpp"

namespace pelagos {

/// Whether a sample is where the water's support may reach: in the patch or not farther than a support radius from it.
[[nodiscard]] bool is_within_reach(const Box& patch, const Eigen::Vector3d& world, double support_radius);

/// What is wrong with the bodies of a scene, each refusal with the body as its field: faults of the mesh; a body
/// outside the patch (one that moves: and not beyond an open edge), nearer than a support radius to a periodic face, or
/// inside another one; an open mesh whose rim stands in water. STATIC bodies may stand in one another (a tower on a
/// rock), but none altogether.
[[nodiscard]] Refusals body_faults(const Scene& scene, double support_radius, std::span<const PlacedShape> bodies);

}  // namespace pelagos
