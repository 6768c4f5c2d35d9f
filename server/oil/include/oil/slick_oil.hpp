#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pelagos {

enum class OilKind {
  kGasoline,
  kDiesel,
  kLightCrude,
  kMediumCrude,
  kHeavyCrude,
  kIfo180,
  kHeavyFuelOil,
  kBunkerC,
};

inline constexpr std::array kOilKinds{OilKind::kGasoline,     OilKind::kDiesel,     OilKind::kLightCrude,
                                      OilKind::kMediumCrude,  OilKind::kHeavyCrude, OilKind::kIfo180,
                                      OilKind::kHeavyFuelOil, OilKind::kBunkerC};

/// What the slick needs to know of an oil, fresh and at 15 degrees C.
struct SlickOil {
  std::string_view name;
  double density;             ///< kg/m^3
  double viscosity;           ///< kinematic, m^2/s
  double api_gravity;         ///< degrees API; the distillation correlations use it
  bool refined;               ///< which of the two distillation correlations holds
  double most_water_content;  ///< volume share of water in the ready emulsion; 0: forms none
};

/// Densities, viscosities and API gravities: ADIOS oil database (NOAA), records GN00003 (gasoline), GN00002 (diesel),
/// GN00006, GN00007, GN00004 (light, medium, heavy crude), AD01676 (IFO 180), AD02431 (fuel oil no. 6: heavy fuel oil)
/// and AD02052 (bunker C). Dynamic viscosities were divided by the density.
/// Water content of emulsions: 0.70 for crudes (Mackay et al. 1982, in Reed 1998); 0.52 for residual fuels, as measured
/// for IFO 300 (Environment Canada's catalogue, ADIOS AD02184); gasoline and diesel form no emulsion.
[[nodiscard]] const SlickOil& slick_oil(OilKind kind);

/// By the table's name ("diesel", "medium crude", ...); empty if there is no such oil.
[[nodiscard]] std::optional<OilKind> find_oil_kind(std::string_view name);

}  // namespace pelagos
