#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/ghosts.hpp"

namespace pelagos {

/// A boundary sample where the water meets it: itself, or its image beyond a mirrored or periodic face.
struct PlacedSample {
  Float4 position;           ///< m; w: V_b, m^3
  std::uint32_t source = 0;  ///< among the given samples
  Float4 sign{1, 1, 1, 1};   ///< velocity = sign * velocity of the source
};

/// The samples, and their images within `reach` of the faces: a body that ends at a mirrored face goes on beyond. No
/// image is made where a sample lies already, as of a body that reaches past the face.
[[nodiscard]] std::vector<PlacedSample> place_with_images(const Region& patch, const std::array<Edge, 3>& edges,
                                                          float reach, float spacing, std::span<const Float4> samples);

}  // namespace pelagos
