#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/placed_shape.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// Which bodies end at a mirrored face of the patch where there is water, one line for each body and face. Bodies have
/// no images beyond such faces, so water leaks past them there: of 640 particles behind a gate of one spacing
/// thickness, 192 in 10 s. A body that reaches past the face by half a spacing or more holds the water; one that keeps
/// a support radius away does not meet the images of the water.
/// @param level  m, world: of the water at rest
[[nodiscard]] std::vector<std::string> mirrored_face_notes(const Scene& scene, double support_radius, double level,
                                                           std::span<const PlacedShape> bodies);

}  // namespace pelagos
