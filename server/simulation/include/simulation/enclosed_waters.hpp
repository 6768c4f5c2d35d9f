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

/// Water that comes to rest at one level: all water of the patch, or a part that walls of bodies separate from the
/// rest, as in a lock or a dock behind its gate.
struct EnclosedWater {
  double level = 0.0;         ///< m, world
  double surface = 0.0;       ///< m^2 of water at that level
  std::size_t particles = 0;  ///< that it holds
};

/// The enclosed waters of a scene at its start.
///
/// Places of particles (lattice_counts) in the whole patch are counted, but for those within half a spacing of a body.
/// Water that starts high drains down its column into the water that it stands over. Each water fills its lowest places
/// first. What a water cannot hold below its lowest sill is shared with the water behind the sill, as if the sill were
/// not there. One pass over the layers from the floor up, with a union-find over the places of each.
///
/// Error: along sloping bodies that start dry the level is up to a third of a spacing too high, since places are whole.
/// @param position  m, local: of the particles at the start
/// @param frame  of the patch
[[nodiscard]] std::vector<EnclosedWater> find_enclosed_waters(TaskPool& pool, const Scene& scene, const Bodies& bodies,
                                                              std::span<const Float4> position,
                                                              const PatchFrame& frame);

/// Level of the water once it is at rest, m, world: of several enclosed waters that of the largest surface, as the sea
/// is the largest water. Without bodies the particles of all blocks are spread over the floor of the patch. Bodies
/// displace what they stand in.
[[nodiscard]] double rest_level(TaskPool& pool, const Scene& scene, const Bodies& bodies,
                                std::span<const Float4> position, const PatchFrame& frame);

}  // namespace pelagos
