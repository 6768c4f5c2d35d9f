#include "oil_commands.hpp"

#include <cmath>

#include "commands.pb.h"
#include "messages/limits.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {
namespace {

constexpr Range kPlaces{-1e6, 1e6, "m"};
constexpr double kLeastDistance = 0.1;  // m, between neighbours of a boom

std::string read_name(const FieldReader& reader) {
  std::string name;
  if (reader.require("name")) reader.read("name", limits::kLongestName, name);
  return name;
}

Eigen::Vector3d read_place(const FieldReader& reader, const char* field) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  if (reader.require(field)) reader.read(field, kPlaces, place);
  return place;
}

std::vector<Eigen::Vector2d> read_line(const FieldReader& reader) {
  std::vector<Eigen::Vector2d> line;
  for (const FieldReader& point : reader.children("point")) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    if (point.has("x")) point.read("x", kPlaces, place.x());
    if (point.has("y")) point.read("y", kPlaces, place.y());
    if (point.has("z")) point.read("z", kPlaces, place.z());  // means nothing, but has to be a number
    if (!line.empty() && (place.head<2>() - line.back()).norm() < kLeastDistance)
      point.fault("", "is " + format_number((place.head<2>() - line.back()).norm()) +
                          " m from the point before; allowed: at least " + format_number(kLeastDistance) + " m");
    line.push_back(place.head<2>());
  }
  if (line.size() < limits::kFewestPoints || line.size() > kMostPointsPerBoom)
    reader.fault("point",
                 "has " + std::to_string(line.size()) + " points; allowed: 2 to " + std::to_string(kMostPointsPerBoom));
  return line;
}

void write_place(const Eigen::Vector3d& from, proto::v1::Vector& to) {
  to.set_x(from.x());
  to.set_y(from.y());
  to.set_z(from.z());
}

void write_place(const Eigen::Vector2d& from, proto::v1::Vector& to) {
  to.set_x(from.x());
  to.set_y(from.y());
}

struct Writer {
  proto::v1::TimedCommand& message;

  void operator()(const ReleaseOil& c) const {
    proto::v1::ReleaseOil& out = *message.mutable_release_oil();
    out.set_name(c.name);
    write_place(c.from, *out.mutable_from());
    write_place(c.to, *out.mutable_to());
    if (c.body != 0) out.set_body(c.body);
    out.set_rate(c.rate);
    if (std::isfinite(c.duration)) out.set_duration(c.duration);
  }
  void operator()(const StopRelease& c) const { message.mutable_stop_release()->set_name(c.name); }
  void operator()(const SpillOil& c) const {
    proto::v1::SpillOil& out = *message.mutable_spill_oil();
    write_place(c.position, *out.mutable_position());
    out.set_volume(c.volume);
    out.set_radius(c.radius);
  }
  void operator()(const SetBoom& c) const {
    proto::v1::SetBoom& out = *message.mutable_set_boom();
    out.set_name(c.name);
    for (const Eigen::Vector2d& point : c.line) write_place(point, *out.add_point());
    out.set_draft(c.draft);
    out.set_critical_speed(c.critical_speed);
  }
  void operator()(const RemoveBoom& c) const { message.mutable_remove_boom()->set_name(c.name); }
  void operator()(const SetSkimmer& c) const {
    proto::v1::SetSkimmer& out = *message.mutable_set_skimmer();
    out.set_name(c.name);
    write_place(c.position, *out.mutable_position());
    out.set_radius(c.radius);
    out.set_rate(c.rate);
  }
  void operator()(const RemoveSkimmer& c) const { message.mutable_remove_skimmer()->set_name(c.name); }
};

}  // namespace

OilCommand read_release_oil(const FieldReader& reader) {
  ReleaseOil command;
  command.name = read_name(reader);
  command.from = read_place(reader, "from");
  command.to = reader.has("to") ? read_place(reader, "to") : command.from;
  reader.read("body", {1, 4294967295.0}, command.body);
  if (reader.require("rate")) reader.read("rate", limits::kReleaseRate, command.rate);
  reader.read("duration", limits::kReleaseDuration, command.duration);
  return command;
}

OilCommand read_stop_release(const FieldReader& reader) { return StopRelease{read_name(reader)}; }

OilCommand read_spill_oil(const FieldReader& reader) {
  SpillOil command;
  command.position = read_place(reader, "position").head<2>();
  if (reader.require("volume")) reader.read("volume", limits::kSpillVolume, command.volume);
  reader.read("radius", limits::kSpillRadius, command.radius);
  return command;
}

OilCommand read_set_boom(const FieldReader& reader) {
  SetBoom command;
  command.name = read_name(reader);
  command.line = read_line(reader);
  reader.read("draft", limits::kBoomDraft, command.draft);
  reader.read("critical_speed", limits::kCriticalSpeed, command.critical_speed);
  return command;
}

OilCommand read_remove_boom(const FieldReader& reader) { return RemoveBoom{read_name(reader)}; }

OilCommand read_set_skimmer(const FieldReader& reader) {
  SetSkimmer command;
  command.name = read_name(reader);
  command.position = read_place(reader, "position").head<2>();
  reader.read("radius", limits::kSkimmerRadius, command.radius);
  reader.read("rate", limits::kSkimmerRate, command.rate);
  return command;
}

OilCommand read_remove_skimmer(const FieldReader& reader) { return RemoveSkimmer{read_name(reader)}; }

void write_oil(const OilCommand& command, proto::v1::TimedCommand& message) { std::visit(Writer{message}, command); }

}  // namespace pelagos
