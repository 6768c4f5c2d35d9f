#include "wire/convert.hpp"

#include <algorithm>
#include <cstring>

#include "pelagos_dds/frames.hpp"

namespace pelagos::wire {

namespace {

/// ENU to the frame, or back.
Eigen::Vector3d turned(const Eigen::Vector3d& v, pelagos_WorldFrame frame) {
  return frame == pelagos_FRAME_NED ? swap_enu_ned(v) : v;
}

/// In the world's axes, or in those of the body that carries the probe.
Eigen::Vector3d turned(const Eigen::Vector3d& v, pelagos_WorldFrame frame, std::uint32_t body) {
  return body != 0 && frame == pelagos_FRAME_NED ? swap_port_starboard(v) : turned(v, frame);
}

}  // namespace

pelagos_ProbeV1 to_wire(const ProbeReading& reading, const Snapshot& snapshot, std::uint64_t source,
                        pelagos_WorldFrame frame) {
  pelagos_ProbeV1 wire{};
  wire.source = source;
  wire.probe = reading.id;
  wire.name = const_cast<char*>(reading.name.c_str());
  wire.frame = snapshot.frame;
  wire.simulation_time = snapshot.simulation_time;
  wire.world_frame = frame;
  wire.position = to_wire(turned(reading.position, frame));
  wire.wet = reading.wet;
  wire.surface = to_wire(turned({reading.position.x(), reading.position.y(), reading.height}, frame));
  wire.normal = to_wire(turned(reading.normal, frame));
  wire.velocity = to_wire(turned(reading.velocity, frame));
  return wire;
}

pelagos_AirV1 air_to_wire(const ProbeReading& reading, const Snapshot& snapshot, std::uint64_t source,
                          pelagos_WorldFrame frame) {
  pelagos_AirV1 wire{};
  wire.source = source;
  wire.probe = reading.id;
  wire.frame = snapshot.frame;
  wire.simulation_time = snapshot.simulation_time;
  wire.world_frame = frame;
  wire.position = to_wire(turned(reading.position, frame));
  wire.velocity = to_wire(turned(reading.air.value(), frame));
  return wire;
}

ProbeReading from_wire(const pelagos_ProbeV1& wire) {
  const auto vector = [&](const pelagos_Vector3& v) { return turned(from_wire(v), wire.world_frame); };
  ProbeReading reading;
  reading.id = wire.probe;
  reading.name = wire.name ? wire.name : "";
  reading.position = vector(wire.position);
  reading.wet = wire.wet;
  reading.height = vector(wire.surface).z();
  reading.normal = vector(wire.normal);
  reading.velocity = vector(wire.velocity);
  return reading;
}

ProbeSettings from_wire(const pelagos_ProbeRequestV1& wire) {
  ProbeSettings probe;
  probe.id = wire.probe;
  probe.name = wire.name[0] != '\0' ? std::string(wire.name) : "probe " + std::to_string(wire.probe);
  probe.body = wire.body;
  probe.position = turned(from_wire(wire.position), wire.frame, wire.body);
  probe.at_surface = wire.at_surface;
  return probe;
}

pelagos_ProbeRequestV1 to_wire(const ProbeSettings& probe, std::uint32_t sender, pelagos_WorldFrame frame) {
  pelagos_ProbeRequestV1 wire{};
  wire.sender = sender;
  wire.probe = probe.id;
  std::memcpy(wire.name, probe.name.c_str(), std::min(probe.name.size(), sizeof(wire.name) - 1));
  wire.body = probe.body;
  wire.frame = frame;
  wire.position = to_wire(turned(probe.position, frame, probe.body));
  wire.at_surface = probe.at_surface;
  return wire;
}

}  // namespace pelagos::wire
