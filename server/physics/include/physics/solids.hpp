#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "physics/particles.hpp"
#include "physics/solid_field.hpp"

namespace pelagos {

// Smooth solid surfaces by mirror pairs. Each particle within the support of a surface knows its distance s from it and
// the unit normal n = grad s into the water. A pair i, j near the same surface has an image pair at the distance
//   r'^2 = r^2 + 4 s_i s_j,   A = r' grad_i r' = x_ij + 2 s_j n_i,   B = -r' grad_j r' = x_ij - 2 s_i n_j
// which is what a mirror makes where the surface is flat, and is the same seen from i and from j where it is curved. So
// the rate of density has an exact adjoint, and what the water gives a solid it takes. A pair near two surfaces has an
// image in each and one in both: their 4 s_i s_j add up. Nothing is sampled, so a surface does not drag on the water.
// (Mirror particles of flat walls: Libersky et al. 1993; the symmetric form for curved walls is our own.)
// Two surfaces that a particle has in reach count with shares: alike and together with 1 where they go on in one
// direction, each with 1 where they stand in a corner. The corrected gradients end towards plain ones where the corner
// is not square.

/// A solid in the water, as placed for the end of the step. The field is in the solid's axes.
struct Solid {
  std::shared_ptr<const SolidField> field;
  Eigen::Matrix3f turn = Eigen::Matrix3f::Identity();  ///< from the solid's axes to local ones
  Eigen::Vector3f place = Eigen::Vector3f::Zero();     ///< m, local, of the solid's origin
  std::int32_t body = -1;                              ///< in FluidState::coupling; -1: never moves
};

/// Normal (local axes) and distance, m, of a solid's surface at a place (m, local) less than `reach` from it or inside.
[[nodiscard]] std::optional<Float4> surface_at(const Solid& solid, const Eigen::Vector3f& place, float reach);

/// Tangent planes of the surfaces near each particle, at the positions where densities were computed. A particle has at
/// most one surface in each of two slots; surfaces that come near each other are in different slots.
struct SolidPlanes {
  static constexpr std::size_t kSlots = 2;
  /// Distance that stands for "no surface", m.
  static constexpr float kNone = 1e15F;

  std::array<std::vector<Float4>, kSlots> plane;  ///< [images too] n, o: distance of x = n.x - o; no surface: 0, -kNone
  std::array<std::vector<float>, kSlots> speed;   ///< [padded] of the surface along n, m/s
  std::array<std::vector<std::int32_t>, kSlots> solid;  ///< [padded] which, or -1
  std::vector<Float4> blend;        ///< [images too] share of slot 0, of slot 1, of both together; smoothness: 1 smooth
  std::vector<std::uint8_t> group;  ///< bit k: some particle of the group has a surface in slot k
  std::vector<Float4> position;     ///< [images too] m, where the planes were found
};

}  // namespace pelagos
