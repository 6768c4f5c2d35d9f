#include "messages/read_current.hpp"

#include "current.pb.h"

namespace pelagos {
namespace {

constexpr double kLargestSpeed = 10.0;  // m/s; the ranges are those of proto/current.proto
constexpr double kLargestDepth = 11e3;  // m; the deepest trench
constexpr double kRounding = 1e-12;     // of a length that was made of speed and direction

constexpr Range kSpeedRange{0.0, kLargestSpeed, "m/s"};
constexpr Range kVelocityRange{-kLargestSpeed, kLargestSpeed, "m/s"};
constexpr Range kDirectionRange{0.0, 360.0, "degrees clockwise from north, where the current sets towards"};
constexpr const char* kOneWay = "allowed: exactly one of speed (with to_deg), velocity";

/// Ranges of what cannot be used together, so that every fault is told at once.
void check_ranges(const FieldReader& reader) {
  double number = 0.0;
  Eigen::Vector3d vector;
  reader.read("speed", kSpeedRange, number);
  reader.read("to_deg", kDirectionRange, number);
  reader.read("velocity", kVelocityRange, vector);
}

void read_vector(const FieldReader& reader, Eigen::Vector3d& velocity) {
  if (reader.has("to_deg")) {
    reader.fault("to_deg", "says the direction twice: velocity has it already");
    return check_ranges(reader);
  }
  Eigen::Vector3d given;
  if (!reader.read("velocity", kVelocityRange, given)) return;
  if (given.z() != 0.0) {
    reader.fault("velocity", "has a vertical part of " + format_number(given.z()) + " m/s; allowed: x and y only");
  } else if (given.norm() > kLargestSpeed * (1.0 + kRounding)) {
    reader.fault("velocity", "is " + format_number(given.norm()) + " m/s long; allowed: 0 to 10 m/s");
  } else {
    velocity = given;
  }
}

void read_velocity(const FieldReader& reader, Eigen::Vector3d& velocity) {
  if (reader.has("speed") && reader.has("velocity")) {
    reader.fault("", std::string("gives its velocity in more than one way; ") + kOneWay);
    return check_ranges(reader);
  }
  if (reader.has("velocity")) return read_vector(reader, velocity);
  if (!reader.has("speed")) return reader.fault("", std::string("gives no velocity; ") + kOneWay);
  double speed = 0.0, to_deg = 0.0;
  const bool speed_valid = reader.read("speed", kSpeedRange, speed);
  const bool direction_valid = reader.read("to_deg", kDirectionRange, to_deg);
  if (!reader.has("to_deg") && speed > 0.0)
    reader.fault("to_deg", "is missing; needed with speed: 0 to 360 degrees, where the current sets towards");
  if (speed_valid && (direction_valid || speed == 0.0)) velocity = current_velocity(speed, to_deg);
}

CurrentShear read_shear(const FieldReader& reader) {
  switch (reader.read_enum("shear")) {
    case proto::v1::Current::LINEAR:
      return CurrentShear::kLinear;
    case proto::v1::Current::SEVENTH_POWER:
      return CurrentShear::kSeventhPower;
    default:
      return CurrentShear::kNone;
  }
}

}  // namespace

CurrentSettings read_current(const FieldReader& reader) {
  CurrentSettings current;
  read_velocity(reader, current.velocity);
  current.shear = read_shear(reader);
  const bool sheared = current.shear != CurrentShear::kNone;
  reader.read("depth", {0.01, kLargestDepth, "m"}, current.depth);
  if (sheared && !reader.has("depth"))
    reader.fault("depth", "is missing; needed with shear: 0.01 to 11000 m, where the current has fallen to zero");
  if (!sheared && reader.has("depth"))
    reader.fault("depth", "has no meaning without shear; allowed: shear: LINEAR or SEVENTH_POWER beside it");
  reader.read("relaxation", {0.5, 3600.0, "s"}, current.relaxation);
  return current;
}

}  // namespace pelagos
