#pragma once

#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

// Two liquids, water and oil, that do not mix (paper section IV, eq. 36 to 43, number density). Every particle has the
// volume V, and delta counts volumes, so the constraints J are those of one liquid. What differs is mass: a particle
// moves under pressure by
//   u_i = -w_i (J'p)_i ,   w_i = rho_ref / rho0_i   ("mobility"; rho_ref is the water's rest density, so w = 1 there)
// so A = J W J' stays symmetric, sum_i rho0_i V u_i is zero to rounding for all pairs, and lighter liquid rises.
// The paper differs: its eq. 40 weighs the neighbour's part by rho0_j / rho0_i. With its own eq. 39 the factor has to
// be (rho0_j / rho0_i)^2; as printed the two phases exchange momentum unequally and nothing is buoyant. Its eq. 43 for
// positions (with 42 and 37) is ours.

/// The second liquid of a scene.
struct PhaseParameters {
  double rest_density = 850.0;  ///< kg/m^3, > 0
  double viscosity = 0.0;       ///< Pa s, dynamic, >= 0
};

/// What pair loops know of two phases. They tell them apart by position.w: 1 for the lighter one, 0 for the other.
struct PhasePair {
  float light_mobility = 1, heavy_mobility = 1;                         ///< w, no unit
  float light_viscosity = 0, heavy_viscosity = 0, mixed_viscosity = 0;  ///< mu / rho_ref, m^2/s; mixed: harmonic mean
  std::vector<float> mobility;                                          ///< [padded] w_i
};

/// Ratio of the two rest densities, the smaller one over the larger, below which a step is not known to be stable.
inline constexpr double kLeastDensityRatio = 0.1;

}  // namespace pelagos
