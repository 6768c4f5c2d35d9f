#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "physics/particles.hpp"
#include "physics/task_pool.hpp"
#include "simulation/bodies.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// Water that comes to rest at one level: the tank's, or that of a part of it which walls of bodies close off, a lock
/// or a dock behind its gate.
struct Basin {
  double level = 0.0;         ///< m, world
  double surface = 0.0;       ///< m^2 of water at that level
  std::size_t particles = 0;  ///< that it holds
};

/// The basins of a scene at its start. The places of particles in the whole tank (lattice_counts) are counted, those
/// within half a spacing of a body left out: what is free at the bottom fills first. Water that starts high drains down
/// its column, then into the basin that it stands over; what a basin cannot hold below its lowest sill is shared with
/// the basin behind, as if the sill were not there. Along sloping bodies that start dry the level is up to a third of a
/// spacing too high, since places are whole. One pass over the layers from the floor up, with a union-find over
/// the places of each.
/// @param position  m, local: of the particles at the start
/// @param frame  of the patch
[[nodiscard]] std::vector<Basin> find_basins(TaskPool& pool, const Scene& scene, const Bodies& bodies,
                                             std::span<const Float4> position, const PatchFrame& frame);

/// Level of the water once it is at rest, m, world. Of several basins that with the largest water surface tells: the
/// sea is the largest water. Without bodies it is the particles of all blocks spread over the tank's floor. Bodies
/// displace what they stand in.
[[nodiscard]] double rest_level(TaskPool& pool, const Scene& scene, const Bodies& bodies,
                                std::span<const Float4> position, const PatchFrame& frame);

}  // namespace pelagos
