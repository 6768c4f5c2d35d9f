#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/placed_shape.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// Which bodies end less than a support radius before a mirrored face of the patch where there is water, one line for
/// each body and face. A body that reaches the face goes on beyond it as its image and holds the water; one that keeps
/// a support radius away does not meet the images of the water.
/// @param level  m, world: of the water at rest
[[nodiscard]] std::vector<std::string> mirrored_face_notes(const Scene& scene, double support_radius, double level,
                                                           std::span<const PlacedShape> bodies);

}  // namespace pelagos
