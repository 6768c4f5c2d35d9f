#pragma once

#include <span>
#include <vector>

#include "physics/fluid.hpp"

namespace pelagos {

// A mirrored face of the patch makes images of all that stands before it. Where a solid meets the face squarely its own
// images and the face's fit together. Where it meets the face at a slant - the foot of a mound, a bed that rises
// towards a side - they count the same water twice: still water sank along the foot of a mound of 2 m in 6 m of water
// at 0.8 m/s. There the face is a surface like the solid, and the two share the images (physics/solids.hpp).

/// Makes surfaces of the mirrored faces that some solid meets at a slant: the lower and upper faces if there, and the
/// first of the two pairs of sides. A particle knows two surfaces at most, so the other pair stays mirrored.
/// @param standing    solids that never move, local
/// @param parameters  in: the patch and its edges; out: edges open where surfaces stand in their place
/// @returns the surfaces, local; none as a rule
[[nodiscard]] std::vector<Solid> take_slanted_faces(std::span<const Solid> standing, FluidParameters& parameters);

}  // namespace pelagos
