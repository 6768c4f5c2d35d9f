#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics/grid.hpp"
#include "physics/particles.hpp"
#include "physics/surface_grid.hpp"

namespace pelagos {

// Loops over particles for the exchange of water, oil and film. Places are local, in metres.

/// Particles and what each is of: kWaterPhase or kOilPhase. Both spans have the same length.
struct ParticlePhases {
  std::span<const Float4> position;
  std::span<const std::uint8_t> phase;
};

/// The particles of water in each of some boxes, in their order. Looks into the cells about the boxes alone.
/// @param cells  that the particles are sorted by
/// @param moved  m: how far particles may have moved since they were sorted; one that has gone farther may be left out
/// @param boxes  an empty box (Eigen::AlignedBox3f()) holds none
[[nodiscard]] std::vector<std::vector<std::uint32_t>> collect_water(const ParticlePhases& particles,
                                                                    const CellGrid& cells, float moved,
                                                                    std::span<const Eigen::AlignedBox3f> boxes);

/// The particle of water nearest to a place, of equals the first; nothing where all are `reach` away or more. Particles
/// of `among` that are oil by now are left out.
[[nodiscard]] std::optional<std::size_t> nearest_water(const ParticlePhases& particles,
                                                       std::span<const std::uint32_t> among,
                                                       const Eigen::Vector3f& place, float reach);

/// Particles of oil in each column of a grid.
[[nodiscard]] std::vector<int> count_oil(const ParticlePhases& particles, const ColumnGrid& grid);

/// The particles of oil that have too little oil around them for a layer, in their order.
/// @param oil       count_oil of the same particles and grid
/// @param column    as many particles in its own column make a layer
/// @param vicinity  or as many in the 3 x 3 columns around
[[nodiscard]] std::vector<std::size_t> find_thin_oil(const ParticlePhases& particles, const ColumnGrid& grid,
                                                     std::span<const int> oil, int column, int vicinity);

}  // namespace pelagos
