#pragma once

#include <cstdint>
#include <string>

namespace pelagos {

/// By which clock a viewer shows frames.
enum class ViewerClock : std::uint8_t {
  kNone,      ///< no frame has come yet
  kArrival,   ///< its own, by the arrival of frames: the server's schedule or its clock is not known
  kMeasured,  ///< the server's, by an exchange of time stamps
  kHost,      ///< the server's, by the system clocks of both machines, which the operator says agree
};

/// Whether the schedule and the clock are those of the server, so that all viewers have the same.
[[nodiscard]] constexpr bool by_server(ViewerClock clock) {
  return clock == ViewerClock::kMeasured || clock == ViewerClock::kHost;
}

/// How well a viewer keeps to the schedule; published on `viewer_status_v1`. Skews are magnitudes of (simulated time
/// drawn) - (schedule at the moment when the picture was shown - delay), over the last 10 s.
struct ViewerStatus {
  std::uint64_t viewer = 0;  ///< drawn at random at its start
  std::uint64_t source = 0;  ///< of the server that it follows; 0: none
  std::string channel;
  std::uint64_t pictures = 0;    ///< drawn since the start
  double simulation_time = 0.0;  ///< s, of the last one
  double delay = 0.0;            ///< s, behind the schedule
  double skew_median = 0.0;      ///< s
  double skew_99 = 0.0;          ///< s, 99 % are below
  ViewerClock clock = ViewerClock::kNone;
  double clock_offset = 0.0;  ///< s, the server's steady clock less the viewer's
  double clock_error = -1.0;  ///< s, the offset is right within that; negative: not known
};

}  // namespace pelagos
