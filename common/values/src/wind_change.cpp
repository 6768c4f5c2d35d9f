#include "values/wind_change.hpp"

#include <fmt/format.h>

#include "values/command.hpp"

namespace pelagos {

namespace {

using Fault = std::optional<Refusal>;

Fault merge_law(const WindChange& change, WindSettings& wind) {
  if (!change.law || *change.law == wind.law) return {};
  const bool other_unit = (*change.law == WindLaw::kPaper) != (wind.law == WindLaw::kPaper);
  if (wind.pulse && other_unit && !change.pulse)
    return Refusal{"law",
                   "counts the pulse otherwise (seconds; PAPER: steps); needed with it: a pulse, or clear_pulse"};
  wind.law = *change.law;
  wind.roughness = default_roughness(wind.law);
  return {};
}

Fault merge_mean(const WindChange& change, const std::optional<WindSettings>& present, WindSettings& wind) {
  if (change.velocity) {
    wind.velocity = *change.velocity;
    return {};
  }
  if (!change.speed && !present)
    return Refusal{"",
                   "gives no mean wind; allowed: exactly one of speed (with from_deg), beaufort (with from_deg), "
                   "velocity"};
  if (!change.speed && !change.from_deg) return {};
  const bool has_direction = present && present->velocity.head<2>().norm() > 0.0;
  const double speed = change.speed.value_or(wind.velocity.head<2>().norm());
  if (!change.from_deg && !has_direction && speed > 0.0)
    return Refusal{"from_deg",
                   "is missing; needed with speed or beaufort: 0 to 360 degrees, where the wind blows from"};
  wind.velocity = wind_velocity(speed, change.from_deg.value_or(has_direction ? wind_from_deg(wind.velocity) : 0.0));
  return {};
}

Fault out_of_range(const char* field, double value, double least, double most, const char* unit) {
  return Refusal{field, fmt::format("{:.7g} is out of range; allowed: {:.7g} to {:.7g} {}", value, least, most, unit)};
}

Fault merge_pulse(const WindChange& change, WindSettings& wind) {
  if (!change.pulse) return {};
  constexpr double kMostSteps = 1e6, kLongest = 3600.0;
  const auto [period, width] = *change.pulse;
  if (wind.law == WindLaw::kPaper) {
    if (period < 1.0 || period > kMostSteps) return out_of_range("pulse.period", period, 1.0, kMostSteps, "steps");
    if (width < 1.0 || width > kMostSteps) return out_of_range("pulse.width", width, 1.0, kMostSteps, "steps");
  } else {
    if (period < 0.01 || period > kLongest) return out_of_range("pulse.period", period, 0.01, kLongest, "s");
    if (width < 0.001 || width > kLongest) return out_of_range("pulse.width", width, 0.001, kLongest, "s");
    if (width > period)
      return Refusal{"pulse.width", fmt::format("{:g} s is longer than the period; allowed: above 0, at most {:g} s "
                                                "(leave the pulse out for a wind that never stops)",
                                                width, period)};
  }
  wind.pulse = change.pulse;
  return {};
}

}  // namespace

WindChange::WindChange(const WindSettings& wind)
    : velocity(wind.velocity),
      amplitude(wind.amplitude),
      length(wind.length),
      roughness(wind.roughness),
      pulse(wind.pulse),
      clear_pulse(!wind.pulse),
      law(wind.law) {
  if (wind.law != WindLaw::kStress) beta = wind.beta;
}

std::optional<Refusal> merge_wind(const WindChange& change, const std::optional<WindSettings>& present,
                                  WindSettings& wind) {
  WindSettings merged = present.value_or(WindSettings{});
  if (change.clear_pulse) merged.pulse.reset();
  if (auto fault = merge_law(change, merged)) return fault;
  if (auto fault = merge_mean(change, present, merged)) return fault;
  merged.amplitude = change.amplitude.value_or(merged.amplitude);
  merged.length = change.length.value_or(merged.length);
  merged.beta = change.beta.value_or(merged.beta);
  if (change.beta && merged.law == WindLaw::kStress)
    return Refusal{"beta", "is used by the laws GUST and PAPER only; allowed with STRESS: leave it out"};
  merged.roughness = change.roughness.value_or(merged.roughness);
  if (auto fault = merge_pulse(change, merged)) return fault;
  wind = merged;
  return {};
}

std::optional<Refusal> merge_wind(const SetWind& command, const std::optional<WindSettings>& present,
                                  WindSettings& wind) {
  auto refusal = merge_wind(command.wind, present, wind);
  if (refusal) refusal->field = refusal->field.empty() ? "wind" : "wind." + refusal->field;
  return refusal;
}

}  // namespace pelagos
