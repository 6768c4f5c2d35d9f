#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "values/scene.hpp"

namespace pelagos {

/// How the water meets the patch's faces: with the corrected solver a wall is a mirror that bodies do not pass.
[[nodiscard]] inline PatchEdges water_edges(PatchEdges edges, SolverKind solver) {
  if (solver != SolverKind::kCorrected) return edges;
  for (PatchEdge& edge : edges)
    if (edge == PatchEdge::kWall) edge = PatchEdge::kMirror;
  return edges;
}
[[nodiscard]] inline PatchEdges water_edges(const Scene& scene) {
  return water_edges(scene.patch_edges, scene.solver.kind);
}

/// How many particles stand along each axis of a block that starts full of water, and where the first one stands.
/// Across an axis with sampled walls: at d, 2d, ... from the block's min face, size/d - 1 of them (a wall's own samples
/// stand on its face). Across a mirrored or periodic axis: at d/2, 3d/2, ..., size/d of them. 0 where there is room for
/// none. A size within 1e-6 spacings of a multiple of d counts as that multiple (1.5 / 0.05 is 29.999...). Counts
/// beyond 10^9 along one axis are given as 10^9.
[[nodiscard]] inline double lattice_offset(PatchEdge edge) { return edge == PatchEdge::kWall ? 1.0 : 0.5; }  // spacings
[[nodiscard]] inline std::array<std::int64_t, 3> lattice_counts(const Box& block, double spacing,
                                                                const PatchEdges& edges = kWallsAround) {
  std::array<std::int64_t, 3> counts{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double intervals = std::floor(block.size()[static_cast<int>(axis)] / spacing + 1e-6);
    const double particles = edges[axis] == PatchEdge::kWall ? intervals - 1.0 : intervals;
    counts[axis] = particles < 1.0 ? 0 : static_cast<std::int64_t>(std::fmin(particles, 1e9));
  }
  return counts;
}

/// Particles that the blocks of a scene make, of water and of oil, before any that would stand inside a body are taken
/// out. A double, so that no scene overflows it; exact up to 2^53.
[[nodiscard]] inline double particle_count(const Box& block, double spacing, const PatchEdges& edges = kWallsAround) {
  const auto counts = lattice_counts(block, spacing, edges);
  return static_cast<double>(counts[0]) * static_cast<double>(counts[1]) * static_cast<double>(counts[2]);
}
[[nodiscard]] inline double particle_count(const Scene& scene) {
  double total = 0.0;
  const auto add = [&](const Box& block) {
    total += particle_count(block, scene.particle_spacing, water_edges(scene));
  };
  for (const Box& block : scene.water.blocks) add(block);
  if (scene.oil)
    for (const Box& block : scene.oil->blocks) add(block);
  return total;
}

}  // namespace pelagos
