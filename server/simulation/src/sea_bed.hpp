#pragma once

#include "physics/floor.hpp"
#include "values/patch_frame.hpp"

namespace pelagos {

/// Gives the nodes of a floor the heights and slopes of the scene's sea bed; it does not move. From the zones inwards
/// the level bottom becomes the bed over blend_width.
/// @param floor  laid over the patch
void shape_bed(const Scene& scene, const PatchFrame& frame, Floor& floor);

}  // namespace pelagos
