#include "messages/read_current.hpp"

#include "current.pb.h"
#include "messages/limits.hpp"

namespace pelagos {
namespace {

constexpr double kRounding = 1e-12;  // of a length that was made of speed and direction

constexpr Range kVelocityRange{-limits::kStrongestCurrent, limits::kStrongestCurrent, "m/s"};
constexpr const char* kOneWay = "allowed: exactly one of speed (with to_deg), velocity";

/// Ranges of what cannot be used together, so that every fault is told at once.
void check_ranges(const FieldReader& reader) {
  double number = 0.0;
  Eigen::Vector3d vector;
  reader.read("speed", limits::kCurrentSpeed, number);
  reader.read("to_deg", limits::kCurrentTo, number);
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
  } else if (given.norm() > limits::kStrongestCurrent * (1.0 + kRounding)) {
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
  const bool speed_valid = reader.read("speed", limits::kCurrentSpeed, speed);
  const bool direction_valid = reader.read("to_deg", limits::kCurrentTo, to_deg);
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
  reader.read("depth", limits::kCurrentDepth, current.depth);
  if (sheared && !reader.has("depth"))
    reader.fault("depth", "is missing; needed with shear: 0.01 to 11000 m, where the current has fallen to zero");
  if (!sheared && reader.has("depth"))
    reader.fault("depth", "has no meaning without shear; allowed: shear: LINEAR or SEVENTH_POWER beside it");
  reader.read("relaxation", limits::kRelaxation, current.relaxation);
  return current;
}

}  // namespace pelagos
