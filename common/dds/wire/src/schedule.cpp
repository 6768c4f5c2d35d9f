#include <algorithm>
#include <cstring>

#include "wire/convert.hpp"

namespace pelagos::wire {

pelagos_ScheduleV1 to_wire(const SchedulePiece& piece, std::uint64_t source) {
  return {source, piece.era, piece.clock_ns, piece.utc_ns, piece.time, piece.rate, piece.limit};
}

SchedulePiece from_wire(const pelagos_ScheduleV1& schedule) {
  return {schedule.era, schedule.clock_ns, schedule.utc_ns, schedule.time, schedule.rate, schedule.limit};
}

pelagos_ViewerStatusV1 to_wire(const ViewerStatus& status) {
  pelagos_ViewerStatusV1 wire{};
  wire.viewer = status.viewer;
  wire.source = status.source;
  std::memcpy(wire.channel, status.channel.data(), std::min(status.channel.size(), sizeof(wire.channel) - 1));
  wire.pictures = status.pictures;
  wire.simulation_time = status.simulation_time;
  wire.delay = status.delay;
  wire.skew_median = status.skew_median;
  wire.skew_99 = status.skew_99;
  wire.clock = static_cast<pelagos_ViewerClock>(status.clock);
  wire.clock_offset = status.clock_offset;
  wire.clock_error = status.clock_error;
  return wire;
}

ViewerStatus from_wire(const pelagos_ViewerStatusV1& wire) {
  ViewerStatus status;
  status.viewer = wire.viewer;
  status.source = wire.source;
  status.channel = wire.channel;
  status.pictures = wire.pictures;
  status.simulation_time = wire.simulation_time;
  status.delay = wire.delay;
  status.skew_median = wire.skew_median;
  status.skew_99 = wire.skew_99;
  status.clock = static_cast<ViewerClock>(wire.clock);
  status.clock_offset = wire.clock_offset;
  status.clock_error = wire.clock_error;
  return status;
}

}  // namespace pelagos::wire
