#include "oil/weathering.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

constexpr double kZeroCelsius = 273.15;
constexpr double kTableTemperature = 288.15;  ///< K, of the table of oils

struct Distillation {
  double start;  ///< T0, K
  double slope;  ///< TG, K
};

Distillation distillation(const OilProperties& oil) {
  if (oil.refined) return {654.45 - 4.6588 * oil.api_gravity, 388.19 - 3.8725 * oil.api_gravity};
  return {532.98 - 3.1295 * oil.api_gravity, 985.62 - 13.597 * oil.api_gravity};
}

}  // namespace

double evaporated_share(const OilProperties& oil, double share, double film, double wind, double temperature_celsius,
                        double water, double dt) {
  if (share >= 1.0 || !(wind > 0.0)) return share;
  constexpr double kA = 6.3, kB = 10.3;
  const Distillation curve = distillation(oil);
  const double temperature = temperature_celsius + kZeroCelsius;
  const double fresh_film = film / (1.0 - share);
  const double exposure = (1.0 - water) * 2.5e-3 * std::pow(wind, 0.78) * dt / fresh_film;
  // The law's integral, F(theta) = F + ln(1 + b E theta) / b with b = B TG / T and E the present rate.
  const double b = kB * curve.slope / temperature;
  const double rate = std::exp(kA - kB * (curve.start + curve.slope * share) / temperature);
  return std::min(1.0, share + std::log1p(b * rate * exposure) / b);
}

double water_content(const OilProperties& oil, double water, double wind, double dt) {
  if (!(oil.most_water_content > 0.0)) return water;
  constexpr double kUptake = 2e-6;
  const double rate = kUptake * (wind + 1.0) * (wind + 1.0) / oil.most_water_content;
  return oil.most_water_content - (oil.most_water_content - water) * std::exp(-rate * dt);
}

double weathered_viscosity(const OilProperties& oil, double share, double water, double temperature_celsius) {
  const double fresh = kinematic_viscosity(oil), centistokes = fresh * 1e6;
  const double exponent =
      centistokes > 38.0 ? 10.0 : -0.0059 * centistokes * centistokes + 0.4461 * centistokes + 1.413;
  const double temperature = temperature_celsius + kZeroCelsius;
  return fresh * std::exp(5000.0 * (1.0 / temperature - 1.0 / kTableTemperature) + exponent * share +
                          2.5 * water / (1.0 - 0.65 * water));
}

double terminal_thickness(double viscosity) {
  return std::clamp(1e-5 + (1e-4 - 1e-5) * (viscosity - 1e-6) / (1e-4 - 1e-6), 1e-5, 1e-4);
}

}  // namespace pelagos
