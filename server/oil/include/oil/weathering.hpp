#pragma once

#include "values/oil.hpp"

namespace pelagos {

/// Evaporation by evaporative exposure (Stiver and Mackay 1984), for the volume share F evaporated:
///   dF / d theta = exp(A - B (T0 + TG F) / T) ,   d theta = K dt / h0 ,   A = 6.3 , B = 10.3
/// with the distillation curve's start T0 and slope TG (K), the temperature T (K), the mass transfer coefficient
/// K = 2.5e-3 U^0.78 m/s (U wind at 10 m, m/s) and the thickness h0 (m) that the film would have without evaporation.
/// Water in the oil slows it by 1 - Y. T0 and TG follow from the API gravity, as correlated for ADIOS (NOAA 1994, to be
/// used with this K): crudes 532.98 - 3.1295 API and 985.62 - 13.597 API, refined products 654.45 - 4.6588 API and
/// 388.19 - 3.8725 API. Volume and mass share are taken as equal (no change of density).
/// A step integrates the law exactly for the conditions it finds, so that any step may be taken.
///   @param share     F before the step, 0..1
///   @param film      m, thickness of the oil, > 0
///   @param wind      m/s, >= 0; no wind, no evaporation
///   @param water     Y, volume share of water in the emulsion
///   @return          F after the step, at most 1
[[nodiscard]] double evaporated_share(const OilProperties& oil, double share, double film, double wind,
                                      double temperature_celsius, double water, double dt);

/// Water uptake (Mackay et al. 1980, 1982):  dY / dt = K (U + 1)^2 (1 - Y / Y_max) ,  K = 2e-6 1/s (m/s)^-2 .
/// Integrated exactly over the step.
[[nodiscard]] double water_content(const OilProperties& oil, double water, double wind, double dt);

/// Kinematic viscosity, m^2/s, of oil that has evaporated by F and taken up Y water:
///   nu = nu_15 exp(5000 (1/T - 1/288.15)) exp(C F) exp(2.5 Y / (1 - 0.65 Y))
/// temperature as in ADIOS (5000 K), emulsion by Mooney (1951) as in Mackay et al. (1982); C = 10 for oils of more than
/// 38e-6 m^2/s, below that -0.0059 c^2 + 0.4461 c + 1.413 with c in 1e-6 m^2/s (the fit of the MOHID oil module).
[[nodiscard]] double weathered_viscosity(const OilProperties& oil, double share, double water,
                                         double temperature_celsius);

/// Thickness at which spreading ends, m, by the fresh oil's viscosity (ADIOS; PyGNOME, gravity-viscous spreading):
/// 1e-5 up to 1e-6 m^2/s, 1e-4 from 1e-4 m^2/s on, linear between.
[[nodiscard]] double terminal_thickness(double viscosity);

}  // namespace pelagos
