#include "waves/wind_sea.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

constexpr double kHeight = 0.30, kHeightRate = 0.004;  // Wilson's, of U^2/g
constexpr double kPeriod = 8.61, kPeriodRate = 0.008;  // of U/g
constexpr double kPeakOverSignificant = 1.05;          // Goda 2003
constexpr double kHour = 3600.0, kKilometre = 1000.0;
constexpr double kCalm = 0.5;                                   // m/s: no wind raises or turns the sea
constexpr double kDecay = 6.0 * kHour, kTurning = 1.0 * kHour;  // s

/// m: the fetch over which the wind raises the height; infinite where it never does.
double fetch_of(double height, const SteadyWind& wind, double gravity) {
  const double scale = wind.speed * wind.speed / gravity, share = height / (kHeight * scale);
  if (share >= 1.0) return HUGE_VAL;
  const double root = (1.0 / std::sqrt(1.0 - share) - 1.0) / kHeightRate;
  return root * root * scale;
}

/// degrees from -180 to 180
double turn_between(double from_deg, double to_deg) { return std::remainder(to_deg - from_deg, 360.0); }

double turned(double from_deg, double turn_deg) {
  const double at = std::fmod(from_deg + turn_deg, 360.0);
  return at < 0.0 ? at + 360.0 : at;
}

}  // namespace

WindSea developed_sea(const SteadyWind& wind, double fetch, double gravity) {
  if (wind.speed < kCalm) return {0.0, 0.0, wind.to_deg};
  const double u = wind.speed, scaled = gravity * fetch / (u * u);
  const double height = kHeight * u * u / gravity * (1.0 - std::pow(1.0 + kHeightRate * std::sqrt(scaled), -2.0));
  const double period = kPeriod * u / gravity * (1.0 - std::pow(1.0 + kPeriodRate * std::cbrt(scaled), -5.0));
  return {height, kPeakOverSignificant * period, wind.to_deg};
}

double fetch_after(double seconds, double wind_speed) {
  return kKilometre * std::pow(seconds / kHour * std::pow(wind_speed, 0.46), 1.0 / 0.73);
}

double time_to_grow(double fetch, double wind_speed) {
  return kHour * std::pow(fetch / kKilometre, 0.73) * std::pow(wind_speed, -0.46);
}

WindSea start_wind_sea(const WindSeaSettings& settings, const SteadyWind& wind, double gravity) {
  const double grown = settings.blown_for ? fetch_after(*settings.blown_for, wind.speed) : settings.fetch;
  return developed_sea(wind, std::min(settings.fetch, grown), gravity);
}

WindSea wind_sea_after(const WindSea& sea, const WindSeaSettings& settings, const SteadyWind& wind, double seconds,
                       double gravity) {
  const double time = settings.pace * seconds;
  const WindSea most = developed_sea(wind, settings.fetch, gravity);
  WindSea next = sea;
  if (sea.height < most.height) {
    const double fetch = std::min(settings.fetch, fetch_of(sea.height, wind, gravity));
    const double later = fetch_after(time_to_grow(fetch, wind.speed) + time, wind.speed);
    next = developed_sea(wind, std::min(settings.fetch, later), gravity);
  } else {
    next.height = most.height + (sea.height - most.height) * std::exp(-time / kDecay);
  }
  next.to_deg = sea.to_deg;
  if (wind.speed < kCalm) return next;
  const double share = sea.height > 0.0 ? 1.0 - std::exp(-time / kTurning) : 1.0;
  next.to_deg = turned(sea.to_deg, share * turn_between(sea.to_deg, wind.to_deg));
  return next;
}

double peak_factor(const WindSea& sea) {
  const double age = sea.peak_period / std::sqrt(sea.height);
  return age <= 3.6 ? 5.0 : age >= 5.0 ? 1.0 : std::exp(5.75 - 1.15 * age);
}

}  // namespace pelagos
