#include "messages/read_wind.hpp"

#include "messages/limits.hpp"
#include "values/beaufort.hpp"
#include "wind.pb.h"

namespace pelagos {
namespace {

constexpr double kRounding = 1e-12;  // of a length that was made of speed and direction

constexpr Range kVelocityRange{-limits::kStrongestWind, limits::kStrongestWind, "m/s"};

void read_optional(const FieldReader& reader, const char* name, const Range& range, std::optional<double>& value) {
  double number = 0.0;
  if (reader.read(name, range, number)) value = number;
}

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

/// The mean wind as speed, beaufort, velocity and from_deg give it.
void read_mean(const FieldReader& reader, WindChange& change) {
  const int ways = (reader.has("speed") ? 1 : 0) + (reader.has("beaufort") ? 1 : 0) + (reader.has("velocity") ? 1 : 0);
  if (ways > 1) {
    reader.fault("", "gives the mean wind in more than one way; allowed: exactly one of speed, beaufort, velocity");
    check_ranges_of_mean(reader);
    return;
  }
  if (reader.has("velocity")) {
    if (reader.has("from_deg")) reader.fault("from_deg", "says the direction twice: velocity has it already");
    Eigen::Vector3d given;
    if (!reader.read("velocity", kVelocityRange, given)) return;
    if (given.norm() > limits::kStrongestWind * (1.0 + kRounding))
      return reader.fault("velocity", "is " + format_number(given.norm()) + " m/s long; allowed: 0 to 75 m/s");
    change.velocity = given;
    return;
  }
  int beaufort = 0;
  read_optional(reader, "speed", limits::kWindSpeed, change.speed);
  if (reader.read("beaufort", limits::kBeaufort, beaufort)) change.speed = beaufort_speed(beaufort);
  read_optional(reader, "from_deg", limits::kWindFrom, change.from_deg);
}

/// Its ranges depend on the law: merge_wind looks at them.
WindPulse read_pulse(const FieldReader& reader) {
  WindPulse pulse;
  reader.require("period");
  reader.require("width");
  reader.read("period", {0.0, 1e6}, pulse.period);
  reader.read("width", {0.0, 1e6}, pulse.width);
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

}  // namespace

WindChange read_wind_change(const FieldReader& reader) {
  WindChange change;
  if (reader.has("law")) change.law = read_law(reader);
  read_mean(reader, change);
  read_optional(reader, "amplitude", limits::kGust, change.amplitude);
  read_optional(reader, "length", limits::kGustLength, change.length);
  read_optional(reader, "beta", limits::kBeta, change.beta);
  read_optional(reader, "roughness", limits::kRoughness, change.roughness);
  if (reader.has("pulse")) change.pulse = read_pulse(reader.child("pulse"));
  return change;
}

WindSettings read_wind(const FieldReader& reader) {
  const std::size_t faults = reader.fault_count();
  const WindChange change = read_wind_change(reader);
  WindSettings wind;
  if (reader.fault_count() != faults) return wind;
  if (const auto refusal = merge_wind(change, std::nullopt, wind)) reader.fault(*refusal);
  return wind;
}

}  // namespace pelagos
