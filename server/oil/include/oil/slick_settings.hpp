#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "scales/scales.hpp"
#include "text/refusal.hpp"
#include "values/oil.hpp"

namespace pelagos {

/// Where the simulation ends: oil stops at closed sides; what leaves over the others is taken out and counted.
struct SlickPatch {
  Eigen::Vector2d min, max;                  ///< m, world; min below max
  std::array<bool, 2> closed{false, false};  ///< for x, y

  /// The place, or that at the closed side nearest to it.
  [[nodiscard]] Eigen::Vector2d keep(const Eigen::Vector2d& place) const {
    Eigen::Vector2d kept = place;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
      if (closed[static_cast<std::size_t>(axis)]) kept[axis] = std::clamp(place[axis], min[axis], max[axis]);
    return kept;
  }
};

/// Oil that piles up thicker than a particle goes back to the particles.
struct ParticleExchange {
  double thickness;      ///< m, > 0: film above it is given back
  double particle_mass;  ///< kg, > 0, of one particle of oil
};

struct SlickSettings {
  OilProperties oil = *find_oil(kDefaultOil);
  double water_density = 1026.0;      ///< kg/m^3, above the oil's density (sea water of 35 psu at 15 degrees C)
  double water_viscosity = 1.15e-6;   ///< m^2/s, > 0 (the same)
  double water_temperature = 15.0;    ///< degrees C, -2 to 50
  double gravity = kStandardGravity;  ///< m/s^2, > 0

  /// Share of the wind's velocity that moves the oil besides the water, 0 to 0.1: 3 % over water that does not move
  /// with the wind's waves (ITOPF: oil drifts with the current and 3 % of the wind), less where the simulated waves
  /// already carry it, by about their Stokes drift of 1 % to 1.6 % of the wind.
  double wind_share = 0.03;
  double wind_share_in_waves = 0.02;

  double inertial_constant = 1.14;           ///< Fay's, gravity-inertial, > 0; 1.53 in ADIOS
  double viscous_constant = 1.45;            ///< Fay's, gravity-viscous, > 0; 1.21 in early ADIOS
  std::optional<double> terminal_thickness;  ///< m, > 0: where spreading ends; empty: by the oil's viscosity

  std::size_t most_elements = 4000;  ///< 1 to 1e6
  double largest_radius = 25.0;      ///< m, > 0: a larger element is split in four, if there is room for them
  bool evaporation = true;
  bool emulsification = true;
  std::optional<SlickPatch> patch;
  std::optional<ParticleExchange> exchange;
};

/// What is wrong with the settings, naming field, value and what is allowed; empty if nothing is.
[[nodiscard]] std::optional<Refusal> find_fault(const SlickSettings& settings);

}  // namespace pelagos
