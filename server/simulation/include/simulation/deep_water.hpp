#pragma once

#include "physics/fluid.hpp"
#include "values/scene.hpp"

namespace pelagos {

// Deep water under the corrected scheme. Corrected gradients make forces that are no exact gradient of an energy; what
// they do to single particles grows with the pressure, so with the depth in spacings, and explicit steps that are right
// for shallow water are too long for it. Still water 60 layers deep and as wide fell into itself within a second (7 %
// of compression): the repair lifted the whole column, which disordered the particles, which made the velocity solve
// leave more to repair. What prevents it, found by experiment: steps in inverse proportion to the depth, and a stronger
// filter (test: HardDepth.AStillSeaOfSixtyAndEightyLayersStaysWhole; table: pelagos-hard deep). Fewer iterations a step
// make up for most of the shorter steps. Up to 30 layers nothing changes. The other schemes are what they are in the
// literature.

/// What changes at a depth.
struct DepthMeasures {
  double filter_factor = 1.0;  ///< on FluidParameters::filter: 1 at 30 layers, 2 at 60 and more
  double step_factor = 1.0;    ///< on the default longest step: 40 / layers beyond 40
};
/// @param layers  greatest depth of the liquids, in spacings
[[nodiscard]] DepthMeasures depth_measures(Scheme scheme, double layers);

/// The largest height of the scene's blocks together, in spacings; 0 without gravity, where depth means nothing.
[[nodiscard]] double depth_in_spacings(const Scene& scene);

}  // namespace pelagos
