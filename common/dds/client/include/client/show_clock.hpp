#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "schedule/clock_offset.hpp"
#include "schedule/schedule_fit.hpp"
#include "values/viewer_status.hpp"

namespace pelagos {

/// The clocks of this machine as a viewer reads them.
struct LocalClocks {
  std::function<std::int64_t()> steady_ns;  ///< empty: std::chrono::steady_clock
  bool trust_host = false;  ///< the system clocks of this machine and of the server's agree, as by PTP: use them

  [[nodiscard]] ClockStamp now() const;
};

/// By which clock the schedule is read.
struct ClockState {
  ViewerClock clock = ViewerClock::kNone;
  std::int64_t offset_ns = 0;           ///< the schedule's clock less the steady clock here
  double error = -1.0;                  ///< s, the offset is right within that; negative: not known
  std::optional<ClockOffset> measured;  ///< also where it is not used
  bool scheduled = false;               ///< the server sends a schedule
};

/// What is due, and by which clock frames were completed.
struct DueInstant {
  ScheduledInstant scheduled;
  ViewerClock clock = ViewerClock::kNone;
};

/// Tells which simulated time is due at a moment of the clock here. It reads the server's schedule by the offset that
/// was measured, or by the system clocks of both machines. Until both are known, and with servers that send no
/// schedule, it makes one from the arrival of frames: then channels differ by the delays of the network.
class ShowClock {
 public:
  explicit ShowClock(bool trust_host) : trust_host_(trust_host) {}

  /// All that was known is of another server.
  void restart();
  void take(const SchedulePiece& piece) { schedule_.add(piece); }
  /// @return false where it is refused, see ClockOffsetFilter
  bool take(const ClockStamps& answer) { return offsets_.add(answer); }
  void frame_arrived(const ClockStamp& now, double time);
  void set_paused(bool paused, const ClockStamp& now);

  [[nodiscard]] ClockState state(const ClockStamp& now) const;
  /// @param at_ns  of the steady clock here   @return nothing before the first frame
  [[nodiscard]] std::optional<DueInstant> at(std::int64_t at_ns, const ClockStamp& now) const;
  /// When a frame was completed, by the server's steady clock. Nothing before the first piece of a schedule.
  [[nodiscard]] std::optional<std::int64_t> completed(std::int64_t wall_time_ns) const;

 private:
  bool trust_host_;
  Schedule schedule_;  ///< of the server
  ClockOffsetFilter offsets_;
  ScheduleFit fit_;  ///< of arrivals
  Schedule arrivals_;
};

}  // namespace pelagos
