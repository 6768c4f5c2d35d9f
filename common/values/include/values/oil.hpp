#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace pelagos {

/// What the physics needs to know of an oil, fresh and at 15 C.
struct OilProperties {
  std::string_view name;
  double density = 0.0;             ///< kg/m^3
  double viscosity = 0.0;           ///< Pa s, dynamic
  double api_gravity = 0.0;         ///< degrees API; the distillation correlations use it
  bool refined = false;             ///< which of the two distillation correlations holds
  double most_water_content = 0.0;  ///< volume share of water in the ready emulsion; 0: forms none
  std::string_view source{};        ///< record of the ADIOS oil database; empty: a scene's own values
  std::string_view weathers_as{};   ///< the oil of the table whose weathering it has; empty: its own
};

/// Oils by name. Densities, viscosities and API gravities are those of ADIOS (NOAA's oil database) at 15 C; where a
/// record has a kinematic viscosity, it times the density, to three digits. Water content of emulsions: 0.70 for crudes
/// (Mackay et al. 1982, in Reed 1998); 0.52 for residual fuels, as measured for IFO 300 (Environment Canada's
/// catalogue, ADIOS AD02184); gasoline and diesel form no emulsion. Cargoes differ from these by some per cent in
/// density and severalfold in viscosity, so an exercise with a particular one gives its own numbers.
inline constexpr std::array<OilProperties, 8> kOils{{
    {"gasoline", 731.53, 0.000782, 61.8, true, 0.0, "GN00003"},
    {"diesel", 852.98, 0.00549, 34.3, true, 0.0, "GN00002"},
    {"light crude", 827.99, 0.00694, 39.2, false, 0.70, "GN00006"},
    {"medium crude", 879.13, 0.0356, 29.3, false, 0.70, "GN00007"},
    {"heavy crude", 963.57, 5.92, 15.2, false, 0.70, "GN00004"},
    {"IFO 180", 967.0, 2.32, 14.7, true, 0.52, "AD01676"},
    {"heavy fuel oil", 983.0, 45.0, 12.3, true, 0.52, "AD02431"},
    {"bunker C", 989.0, 8.71, 11.4, true, 0.52, "AD02052"},
}};

/// What a scene means that says nothing else.
inline constexpr std::string_view kDefaultOil = "medium crude";

/// The oil of that very name; none if it is not in the table.
[[nodiscard]] constexpr std::optional<OilProperties> find_oil(std::string_view name) {
  for (const OilProperties& oil : kOils)
    if (oil.name == name) return oil;
  return std::nullopt;
}

/// The oil of the table that is nearest in density.
[[nodiscard]] inline const OilProperties& nearest_oil(double density) {
  const OilProperties* nearest = kOils.data();
  for (const OilProperties& oil : kOils)
    if (std::abs(oil.density - density) < std::abs(nearest->density - density)) nearest = &oil;
  return *nearest;
}

/// An oil of a scene's own values; it weathers as the one of the table that is nearest in density.
[[nodiscard]] inline OilProperties own_oil(double density, double viscosity) {
  OilProperties oil = nearest_oil(density);
  oil.weathers_as = oil.name;
  oil.name = "oil";
  oil.density = density;
  oil.viscosity = viscosity;
  oil.source = {};
  return oil;
}

/// m^2/s.
[[nodiscard]] constexpr double kinematic_viscosity(const OilProperties& oil) { return oil.viscosity / oil.density; }

}  // namespace pelagos
