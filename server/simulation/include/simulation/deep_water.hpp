#pragma once

#include "physics/fluid.hpp"
#include "values/scene.hpp"

namespace pelagos {

// Deep water under the corrected scheme. Corrected gradients make forces that are no exact gradient of an energy; what
// they pump into single particles grows with the pressure, so with the depth in spacings. Still water 60 layers deep
// and as wide fell into itself within a second (7 % of compression): the repair lifted the whole column, which
// disordered the particles, which made the velocity solve leave more to repair. What breaks that circle, found by
// experiment (test: HardDepth.AStillSeaOfSixtyAndEightyLayersStaysWhole; table: pelagos-hard deep):
//   - the repair takes a few iterations a step, so it mends what is local and leaves the column to the velocity solve;
//   - the filter is stronger;
//   - steps are shorter.
// Up to 30 layers nothing changes. The other schemes are what they are in the literature.

/// What changes at a depth.
struct DepthMeasures {
  double filter_factor = 1.0;  ///< on FluidParameters::filter: 1 at 30 layers, 2 at 60 and more
  int repair_iterations = 0;   ///< FluidParameters::repair_iterations: 4 beyond 40 layers
  double step_factor = 1.0;    ///< on the default longest step: 60 / layers beyond 60
};
/// @param layers  greatest depth of the liquids, in spacings
[[nodiscard]] DepthMeasures depth_measures(Scheme scheme, double layers);

/// The largest height of the scene's blocks together, in spacings; 0 without gravity, where depth means nothing.
[[nodiscard]] double depth_in_spacings(const Scene& scene);

/// Filter and repair of these parameters, as their scheme wants them at this depth.
void suit_depth(double layers, FluidParameters& parameters);

}  // namespace pelagos
