#include "client/show_clock.hpp"

#include <chrono>
#include <cmath>

namespace pelagos {

namespace {

/// The offset of clocks that a stranger's stamps are compared with: what is beyond has no use.
constexpr double kMostNs = 4e18;

template <class Clock>
std::int64_t read() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

}  // namespace

ClockStamp LocalClocks::now() const {
  return {steady_ns ? steady_ns() : read<std::chrono::steady_clock>(), read<std::chrono::system_clock>()};
}

void ShowClock::restart() {
  schedule_.clear();
  offsets_.clear();
  arrivals_.clear();
  fit_ = {};
}

void ShowClock::frame_arrived(const ClockStamp& now, double time) {
  if (const auto piece = fit_.add_frame(now, time)) arrivals_.add(*piece);
}

void ShowClock::set_paused(bool paused, const ClockStamp& now) {
  if (const auto piece = paused ? fit_.pause() : fit_.resume(now)) arrivals_.add(*piece);
}

ClockState ShowClock::state(const ClockStamp& now) const {
  ClockState state;
  state.measured = offsets_.offset(now.clock_ns);
  state.scheduled = !schedule_.empty();
  if (!arrivals_.empty()) state.clock = ViewerClock::kArrival;
  if (schedule_.empty()) return state;
  if (trust_host_) {
    const SchedulePiece& piece = schedule_.newest();
    const double offset = (static_cast<double>(now.utc_ns) - static_cast<double>(now.clock_ns)) -
                          (static_cast<double>(piece.utc_ns) - static_cast<double>(piece.clock_ns));
    if (std::abs(offset) > kMostNs) return state;
    state.clock = ViewerClock::kHost;
    state.offset_ns = (now.utc_ns - now.clock_ns) - (piece.utc_ns - piece.clock_ns);
  } else if (state.measured) {
    state.clock = ViewerClock::kMeasured;
    state.offset_ns = state.measured->ns;
    state.error = state.measured->error;
  }
  return state;
}

std::optional<DueInstant> ShowClock::at(std::int64_t at_ns, const ClockStamp& now) const {
  const ClockState known = state(now);
  // As unsigned numbers, which do not overflow: the offset may be as large as a stamp.
  const auto there =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(at_ns) + static_cast<std::uint64_t>(known.offset_ns));
  const auto due = by_server(known.clock) ? schedule_.at(there) : arrivals_.at(at_ns);
  if (!due) return std::nullopt;
  return DueInstant{*due, known.clock};
}

std::optional<std::int64_t> ShowClock::completed(std::int64_t wall_time_ns) const {
  if (schedule_.empty()) return std::nullopt;
  const SchedulePiece& piece = schedule_.newest();
  const double since = static_cast<double>(wall_time_ns) - static_cast<double>(piece.utc_ns);
  if (std::abs(since) > kMostNs) return std::nullopt;
  return piece.clock_ns + (wall_time_ns - piece.utc_ns);
}

}  // namespace pelagos
