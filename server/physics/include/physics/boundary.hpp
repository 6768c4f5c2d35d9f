#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "physics/ghosts.hpp"
#include "physics/grid.hpp"
#include "physics/particles.hpp"

namespace pelagos {

/// One layer of samples on the six faces of a closed box, about `spacing` apart, corners and edges once.
[[nodiscard]] std::vector<Float4> sample_box(const Region& box, double spacing);

/// The same with volumes, on the faces across axes with Edge::kWall only. Where such a face meets a mirrored or
/// periodic one, its samples go on for one support radius, so that the wall looks the same beyond.
[[nodiscard]] std::vector<Float4> sample_patch_walls(TaskPool& pool, const Region& patch,
                                                     const std::array<Edge, 3>& edges, double spacing,
                                                     double support_radius);

/// Volumes of boundary samples, V_b = 1 / sum_b' W_bb' over the samples of the same body (Akinci et al. 2012, eq. 4, in
/// volume form); written to w.
void assign_boundary_volumes(TaskPool& pool, double support_radius, std::span<Float4> samples);

/// Whether two directions into a body belong to the two sides of a plate. A zero direction belongs to both sides.
template <class Vector>
[[nodiscard]] bool are_opposed(const Vector& a, const Vector& b) {
  return a.dot(b) < -0.5F;
}

/// The same where plates have a layer of samples on each of their sides. Water that stands `clearance` away from the
/// near layer must feel what it feels before a single one, so a sample of the far layer counts by the part of itself
/// that reaches that water: wholly where the layers fall together, not at all where the far one is out of reach.
/// @param inward     of each sample, unit, from its side of the surface, or zero
/// @param clearance  m, of the water from the layer, > 0
void assign_boundary_volumes(TaskPool& pool, double support_radius, std::span<const Eigen::Vector3f> inward,
                             double clearance, std::span<Float4> samples);

/// Particles of a block of water: at spacing, 2 spacing, ... from its lower corner, size / spacing - 1 along each axis.
[[nodiscard]] std::array<std::size_t, 3> block_particles(const std::array<double, 3>& size, double spacing);

}  // namespace pelagos
