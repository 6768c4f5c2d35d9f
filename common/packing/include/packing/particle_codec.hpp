#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "packing/surface_particle.hpp"

namespace pelagos {

// Surface particles <-> records of 20 octets, as idl/pelagos.idl states them bit by bit (OceanFrameV1.payload).
// Largest errors, for what lies inside the ranges:
//   position     box_size / 131070 for each axis (and the rounding of float32)
//   orientation  0.0048 rad;  the sign of the quaternion is not kept
//   semi-axes    1.1 %, between 1/16 and 15.65 particle spacings; beyond they are clamped
//   velocity     largest_speed / 1022 for each axis
//   phase, foam, spray exact

inline constexpr std::size_t kRecordBytes = 20;

/// Coordinates and speeds beyond this are faults, not data: m, m/s.
inline constexpr float kLargestPackedMagnitude = 1e6F;

/// The scales that a frame's records refer to.
struct PackingScales {
  Eigen::Vector3f box_min = Eigen::Vector3f::Zero();   ///< m, relative to the frame's origin
  Eigen::Vector3f box_size = Eigen::Vector3f::Zero();  ///< m, >= 0
  float largest_speed = 0.0F;                          ///< m/s, >= 0
  float particle_spacing = 0.0F;                       ///< m, > 0
};

/// Finite, not negative, and within kLargestPackedMagnitude.
[[nodiscard]] bool are_plausible(const PackingScales& scales);

struct PackReport {
  PackingScales scales;
  std::uint32_t packed = 0;
  std::uint32_t refused = 0;  ///< left out: not finite, absurdly large, semi-axes not positive, or no rotation
};

/// Fills `records` with kRecordBytes for each particle that is fit to be packed, in order. The scales are the tight box
/// and the largest speed of those particles. `particle_spacing` must be > 0 and finite; otherwise all are refused.
PackReport pack_particles(std::span<const SurfaceParticle> particles, float particle_spacing,
                          std::vector<std::uint8_t>& records);

/// False, with `particles` empty, if the scales are not plausible or `records` is not a whole number of records.
/// Every value of every record decodes to something finite, with a unit quaternion.
[[nodiscard]] bool unpack_particles(std::span<const std::uint8_t> records, const PackingScales& scales,
                                    std::vector<SurfaceParticle>& particles);

}  // namespace pelagos
