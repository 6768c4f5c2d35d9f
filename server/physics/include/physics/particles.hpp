#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fields/fields.hpp"

namespace pelagos {

/// The record that pair loops gather: one 16-byte load brings a neighbour's coordinates and one scalar.
struct alignas(16) Float4 {
  float x = 0, y = 0, z = 0, w = 0;
};
/// Its first three numbers.
[[nodiscard]] inline Eigen::Vector3f vector_of(const Float4& p) { return {p.x, p.y, p.z}; }

template <>
struct ScalarLayout<Float4> {
  using Scalar = float;
  static constexpr std::size_t count = 4;
};

/// The liquids of a scene by number, as particles carry them.
inline constexpr std::uint8_t kWaterPhase = 0, kOilPhase = 1;

/// FluidParticles::label.w of a particle that moves as it is given, see physics/held_water.hpp.
inline constexpr float kHeld = 1.0F;

/// Lanes of a group: 16 consecutive particles are worked on together.
inline constexpr std::size_t kLanes = 16;

/// Whole groups with at least one dummy, and one group more: whole vectors may be read from any particle on.
[[nodiscard]] constexpr std::size_t padded_count(std::size_t count) { return ((count + kLanes) / kLanes + 1) * kLanes; }

/// The far dummy that pads arrays of positions.
inline constexpr Float4 kFarRecord{1e9F, 1e9F, 1e9F, 0.0F};

/// Fluid particles, in cell order (re-sorted every step). Positions in metres relative to the world's origin.
/// All particles have the same volume V = d^3, whatever their phase; density is in volume form, delta = rho / rho0 (no
/// unit), and does not see phases (paper eq. 36).
/// Arrays hold `padded_count(count)` entries, so that a group of lanes may be read whole; entries past `count` are a
/// far dummy that contributes nothing.
struct FluidParticles {
  std::size_t count = 0;
  std::vector<Float4> position;            ///< x, y, z; w: 1 for the lighter of two phases, else 0; set by each step
  std::vector<Float4> velocity;            ///< m/s
  std::vector<Float4> acceleration;        ///< m/s^2, of the last step: gravity, viscosity, wind
  std::vector<float> density;              ///< delta, at the positions at the end of the step
  std::vector<float> density_pressure;     ///< m^2, warm start of the density solve
  std::vector<float> divergence_pressure;  ///< m^2, of the divergence solve of this step
  std::vector<std::uint32_t> id;           ///< stable identity, given once: the index at creation, counted on
  std::vector<std::uint8_t> phase;         ///< kWaterPhase or kOilPhase; empty where the scene has no oil
  /// Where an open sea's water rests (x, y: m, local; z: m above the mean level); w: kHeld or 0. Empty in other seas.
  std::vector<Float4> label;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    bool phases = !self.phase.empty(), labels = !self.label.empty();
    visit("count", self.count);
    visit("phases", phases);
    const std::size_t n = self.count, padded = padded_count(n);
    visit("position", PaddedRows{self.position, n, padded, kFarRecord});
    visit("velocity", PaddedRows{self.velocity, n, padded, Float4{}});
    visit("acceleration", PaddedRows{self.acceleration, n, padded, Float4{}});
    visit("density", PaddedRows{self.density, n, padded, 0.0F});
    visit("density_pressure", PaddedRows{self.density_pressure, n, padded, 0.0F});
    visit("divergence_pressure", PaddedRows{self.divergence_pressure, n, padded, 0.0F});
    visit("id", PaddedRows{self.id, n, padded, 0U});
    visit("phase", PaddedRows{self.phase, phases ? n : 0, phases ? padded : 0, kWaterPhase});
    visit("labels", labels);
    visit("label", PaddedRows{self.label, labels ? n : 0, labels ? padded : 0, Float4{}});
  }
};

/// Boundary samples (Akinci et al. 2012): position and volume V_b in one record, and the velocity of the wall.
struct BoundaryParticles {
  std::size_t count = 0;
  std::vector<Float4> position;  ///< x, y, z in m; w = V_b in m^3
  std::vector<Float4> velocity;  ///< m/s
};

}  // namespace pelagos
