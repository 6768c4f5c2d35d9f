#pragma once

#include "physics/fluid.hpp"
#include "values/scene.hpp"

namespace pelagos {

// Deep water under the corrected scheme. Its forces are not the exact gradient of an energy. Their error at single
// particles grows with the pressure, that is with the depth in spacings, and steps that suit shallow water are too long
// for deep water: the repair lifts the whole column and disorders the particles, and the next velocity solve leaves
// more compression to repair, until the column collapses. Shorter steps and a stronger filter prevent this; both were
// found by experiment (test: HardDepth.AStillSeaOfSixtyAndEightyLayersStaysWhole; table: pelagos-hard deep). A shorter
// step needs fewer iterations, which saves most of its cost. Up to 30 layers nothing changes. The other schemes stay
// as the literature has them.

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
