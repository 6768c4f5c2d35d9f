#pragma once

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// How far inside a body's surface its boundary samples lie where a scene does not say, in spacings. Water lies in
/// layers along flat faces and stands further off curved ones: calibrated on the drafts of free boxes, and on the
/// buoyancy of held spheres and a ship's hull (1.04 to 1.07 of it with the boxes' value). A body counts as one of flat
/// faces where nine tenths of its area are triangles that meet others in a plane or at 40 degrees and more.
[[nodiscard]] double default_sample_inset(const TriangleMesh& mesh);

}  // namespace pelagos
