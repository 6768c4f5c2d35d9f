#include "wire/convert.hpp"

namespace pelagos::wire {

namespace {

/// Body axes of NED have y and z the other way; moments turn with them.
Eigen::Vector3d turned(const Eigen::Vector3d& v, pelagos_WorldFrame frame) {
  return frame == pelagos_FRAME_NED ? Eigen::Vector3d(v.x(), -v.y(), -v.z()) : v;
}

}  // namespace

pelagos_BodyLoadV1 to_wire(const BodyLoad& load, const Snapshot& snapshot, std::uint64_t source,
                           pelagos_WorldFrame frame) {
  const auto vector = [&](const Eigen::Vector3d& v) { return to_wire(turned(v, frame)); };
  pelagos_BodyLoadV1 wire{};
  wire.source = source;
  wire.body = load.body;
  wire.frame = snapshot.frame;
  wire.simulation_time = snapshot.simulation_time;
  wire.frame_of_body = frame;
  wire.point = vector(load.point);
  wire.force = vector(load.force);
  wire.moment = vector(load.moment);
  wire.buoyant_force = vector(load.buoyant_force);
  wire.buoyant_moment = vector(load.buoyant_moment);
  wire.peak_force = load.peak_force;
  wire.peak_moment = load.peak_moment;
  wire.wetted_volume = load.wetted_volume;
  wire.wetted_area = load.wetted_area;
  return wire;
}

BodyLoad from_wire(const pelagos_BodyLoadV1& wire) {
  const auto vector = [&](const pelagos_Vector3& v) { return turned(from_wire(v), wire.frame_of_body); };
  BodyLoad load;
  load.body = wire.body;
  load.point = vector(wire.point);
  load.force = vector(wire.force);
  load.moment = vector(wire.moment);
  load.buoyant_force = vector(wire.buoyant_force);
  load.buoyant_moment = vector(wire.buoyant_moment);
  load.peak_force = wire.peak_force;
  load.peak_moment = wire.peak_moment;
  load.wetted_volume = wire.wetted_volume;
  load.wetted_area = wire.wetted_area;
  return load;
}

}  // namespace pelagos::wire
