#include "messages/read_wind.hpp"

#include "messages/limits.hpp"
#include "values/beaufort.hpp"
#include "wind.pb.h"

namespace pelagos {
namespace {

constexpr double kRounding = 1e-12;  // of a length that was made of speed and direction

constexpr Range kVelocityRange{-limits::kStrongestWind, limits::kStrongestWind, "m/s"};

/// Ranges of what cannot be used together, so that every fault is told at once.
void check_ranges_of_mean(const FieldReader& reader) {
  double number = 0.0;
  int beaufort = 0;
  Eigen::Vector3d velocity;
  reader.read("speed", limits::kWindSpeed, number);
  reader.read("beaufort", limits::kBeaufort, beaufort);
  reader.read("velocity", kVelocityRange, velocity);
  reader.read("from_deg", limits::kWindFrom, number);
}

/// Mean wind out of speed, beaufort, velocity and from_deg.
void read_mean(const FieldReader& reader, const std::optional<WindSettings>& present, Eigen::Vector3d& velocity) {
  const bool speed_given = reader.has("speed");
  const bool beaufort_given = reader.has("beaufort");
  const bool velocity_given = reader.has("velocity");
  const int ways = (speed_given ? 1 : 0) + (beaufort_given ? 1 : 0) + (velocity_given ? 1 : 0);
  if (ways > 1) {
    reader.fault("", "gives the mean wind in more than one way; allowed: exactly one of speed, beaufort, velocity");
    check_ranges_of_mean(reader);
    return;
  }
  if (ways == 0 && !present) {
    reader.fault("",
                 "gives no mean wind; allowed: exactly one of speed (with from_deg), beaufort (with from_deg), "
                 "velocity");
    return;
  }
  if (velocity_given) {
    if (reader.has("from_deg")) reader.fault("from_deg", "says the direction twice: velocity has it already");
    Eigen::Vector3d given;
    if (!reader.read("velocity", kVelocityRange, given)) return;
    if (given.norm() > limits::kStrongestWind * (1.0 + kRounding)) {
      reader.fault("velocity", "is " + format_number(given.norm()) + " m/s long; allowed: 0 to 75 m/s");
      return;
    }
    velocity = given;
    return;
  }

  const bool has_direction = present && present->velocity.head<2>().norm() > 0.0;
  double speed = present ? present->velocity.head<2>().norm() : 0.0;
  double from_deg = has_direction ? wind_from_deg(present->velocity) : 0.0;
  int beaufort = 0;
  reader.read("speed", limits::kWindSpeed, speed);
  if (reader.read("beaufort", limits::kBeaufort, beaufort)) speed = beaufort_speed(beaufort);
  reader.read("from_deg", limits::kWindFrom, from_deg);
  if (!reader.has("from_deg") && !has_direction && speed > 0.0) {
    reader.fault("from_deg", "is missing; needed with speed or beaufort: 0 to 360 degrees, where the wind blows from");
  }
  const bool unchanged = ways == 0 && !reader.has("from_deg");
  if (!unchanged) velocity = wind_velocity(speed, from_deg);
}

/// The pulse of the paper's law: counted in steps, and taken as printed.
WindPulse read_pulse_in_steps(const FieldReader& reader) {
  constexpr Range kSteps{1.0, 1e6, "steps"};
  WindPulse pulse;
  reader.require("period");
  reader.require("width");
  reader.read("period", kSteps, pulse.period);
  reader.read("width", kSteps, pulse.width);
  return pulse;
}

WindPulse read_pulse(const FieldReader& reader) {
  WindPulse pulse;
  reader.require("period");
  reader.require("width");
  const bool period_valid = reader.read("period", {0.01, 3600.0, "s"}, pulse.period);
  const bool width_valid = reader.read("width", {0.001, 3600.0, "s"}, pulse.width);
  if (period_valid && width_valid && pulse.width > pulse.period) {
    reader.fault("width", format_number(pulse.width) + " s is longer than the period; allowed: above 0, at most " +
                              format_number(pulse.period) + " s (leave the pulse out for a wind that never stops)");
  }
  return pulse;
}

WindLaw read_law(const FieldReader& reader) {
  switch (reader.read_enum("law")) {
    case proto::v1::Wind::STRESS:
      return WindLaw::kStress;
    case proto::v1::Wind::PAPER:
      return WindLaw::kPaper;
    default:
      return WindLaw::kGust;
  }
}

/// A law that replaces another one brings its own roughness, and its pulse counts something else.
void change_law(const FieldReader& reader, WindLaw law, WindSettings& wind) {
  if (law == wind.law) return;
  const bool other_unit = (law == WindLaw::kPaper) != (wind.law == WindLaw::kPaper);
  if (wind.pulse && other_unit && !reader.has("pulse"))
    reader.fault("law", "counts the pulse otherwise (seconds; PAPER: steps); needed with it: a pulse, or clear_pulse");
  wind.law = law;
  wind.roughness = default_roughness(law);
}

}  // namespace

WindSettings read_wind(const FieldReader& reader, const std::optional<WindSettings>& present) {
  WindSettings wind = present.value_or(WindSettings{});
  if (reader.has("law")) change_law(reader, read_law(reader), wind);
  read_mean(reader, present, wind.velocity);
  reader.read("amplitude", limits::kGust, wind.amplitude);
  reader.read("length", limits::kGustLength, wind.length);
  reader.read("beta", limits::kBeta, wind.beta);
  if (reader.has("beta") && wind.law == WindLaw::kStress)
    reader.fault("beta", "is used by the laws GUST and PAPER only; allowed with STRESS: leave it out");
  reader.read("roughness", limits::kRoughness, wind.roughness);
  if (reader.has("pulse")) {
    const FieldReader pulse = reader.child("pulse");
    wind.pulse = wind.law == WindLaw::kPaper ? read_pulse_in_steps(pulse) : read_pulse(pulse);
  }
  return wind;
}

}  // namespace pelagos
