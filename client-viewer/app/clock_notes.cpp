#include "app/clock_notes.hpp"

#include <cmath>
#include <cstdio>

namespace pelagos {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kClockWaitNs = 3 * kSecond;      // for the first answer
constexpr std::int64_t kSkewIntervalNs = 10 * kSecond;  // between lines
constexpr double kMostSkew = 1.0 / 60.0;                // s
constexpr double kMostHostDifference = 5e-3;            // s, of system clocks that are said to agree

}  // namespace

void ClockNotes::look(const Presentation& view) {
  const std::int64_t now = source_.now_ns();
  if (!first_ns_) first_ns_ = told_skew_ns_ = now;
  if (now - looked_ns_ < kSecond / 2) return;
  looked_ns_ = now;
  const ClockState state = source_.clock_state();
  if (state.clock != told_) tell_clock(state);
  if (state.clock == ViewerClock::kArrival && now - *first_ns_ > kClockWaitNs) warn_of_arrival(view, now);
  if (state.clock == ViewerClock::kHost) compare_host(state);
  if (now - told_skew_ns_ < kSkewIntervalNs) return;
  told_skew_ns_ = now;
  tell_skew(view);
}

void ClockNotes::tell_clock(const ClockState& state) {
  const double offset = 1e-9 * static_cast<double>(state.offset_ns);
  if (state.clock == ViewerClock::kMeasured)
    std::fprintf(stderr, "pelagos-viewer: clock: the server's is %.6f s ahead of this one, measured within %.3f ms\n",
                 offset, 1e3 * state.error);
  if (state.clock == ViewerClock::kHost && state.scheduled)
    std::fprintf(stderr,
                 "pelagos-viewer: clock: the server's is %.6f s ahead of this one, by the system clocks of both\n",
                 offset);
  if (by_server(told_) && !by_server(state.clock))
    std::fprintf(stderr, "pelagos-viewer: clock: the server's is not known any more\n");
  told_ = state.clock;
}

void ClockNotes::warn_of_arrival(const Presentation& view, std::int64_t now_ns) {
  if (warned_of_arrival_ || view.frame() == nullptr) return;
  warned_of_arrival_ = true;
  const OceanFrame& frame = *view.frame();
  const double since_made = 1e-9 * (static_cast<double>(system_time_ns()) - static_cast<double>(frame.wall_time_ns));
  const double way = since_made - 1e-9 * static_cast<double>(now_ns - frame.received_ns);
  std::fprintf(stderr,
               "pelagos-viewer: warning: clock: the server does not tell its clock (an older one, or the domain's "
               "permissions forbid it). Frames are shown by their arrival: channels on several machines differ by the "
               "delays of the network\n");
  if (std::abs(way) > 1.0)
    std::fprintf(stderr,
                 "pelagos-viewer: warning: clock: the system clocks of the server and of this machine differ by "
                 "%.3f s, the way of a frame included\n",
                 way);
}

void ClockNotes::compare_host(const ClockState& state) {
  if (warned_of_host_ || !state.measured) return;
  const double difference = 1e-9 * static_cast<double>(state.measured->ns - state.offset_ns);
  if (std::abs(difference) < kMostHostDifference + state.measured->error) return;
  warned_of_host_ = true;
  std::fprintf(
      stderr,
      "pelagos-viewer: warning: clock: --clock host: the system clocks differ by %.1f ms, measured within %.1f "
      "ms; set them, or use --clock measured\n",
      1e3 * difference, 1e3 * state.measured->error);
}

void ClockNotes::tell_skew(const Presentation& view) {
  const double most = view.skew().recent(0.99);
  if (most <= kMostSkew) return;
  std::fprintf(
      stderr,
      "pelagos-viewer: skew over the last 10 s: median %.1f ms, 99 %% within %.1f ms (16.7 ms is a picture at 60 "
      "Hz): pictures are late or frames are missing\n",
      1e3 * view.skew().recent(0.5), 1e3 * most);
}

}  // namespace pelagos
