#include "probe_commands.hpp"

#include "commands.pb.h"

namespace pelagos {

namespace {

constexpr Range kIds{1.0, 4294967295.0};

}  // namespace

SetProbe read_set_probe(const FieldReader& reader) {
  ProbeSettings probe;
  reader.require("id");
  reader.read("id", kIds, probe.id);
  probe.name = "probe " + std::to_string(probe.id);
  reader.read("name", 64, probe.name);
  if (reader.has("body")) reader.read("body", kIds, probe.body);
  if (reader.require("position")) {
    reader.read("position", {-1e6, 1e6, "m"}, probe.position);
    probe.at_surface = probe.body == 0 && !reader.child("position").has("z");
  }
  reader.read("at_surface", probe.at_surface);
  return {probe};
}

RemoveProbe read_remove_probe(const FieldReader& reader) {
  RemoveProbe command;
  reader.require("id");
  reader.read("id", kIds, command.id);
  return command;
}

void write_probe(const SetProbe& command, proto::v1::TimedCommand& message) {
  const ProbeSettings& probe = command.probe;
  proto::v1::SetProbe& out = *message.mutable_set_probe();
  out.set_id(probe.id);
  out.set_name(probe.name);
  if (probe.body != 0) out.set_body(probe.body);
  out.mutable_position()->set_x(probe.position.x());
  out.mutable_position()->set_y(probe.position.y());
  out.mutable_position()->set_z(probe.position.z());
  out.set_at_surface(probe.at_surface);
}

void write_probe(const RemoveProbe& command, proto::v1::TimedCommand& message) {
  message.mutable_remove_probe()->set_id(command.id);
}

}  // namespace pelagos
