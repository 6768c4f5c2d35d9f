#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "schedule/schedule.hpp"

namespace pelagos {

/// One moment by two clocks of a machine.
struct ClockStamp {
  std::int64_t clock_ns = 0;  ///< steady clock
  std::int64_t utc_ns = 0;    ///< system clock, since 1970
};

/// Makes a schedule from the moments at which frames were completed. These come early and late by the time that steps
/// take. The schedule follows the median of the last frames: its rate is the median of the slopes between them
/// (Theil 1950, Sen 1968; a quarter of them may be outliers), and what it is off by is made good at the rate of 1 /s.
/// Within an era it never goes back.
class ScheduleFit {
 public:
  static constexpr std::size_t kMostPoints = 64;
  static constexpr double kLongestWindow = 4.0;  ///< s, by the clock, that the fit looks back
  static constexpr double kAhead = 0.2;          ///< s, simulated: so far it goes on after the last frame, at least
  static constexpr double kJump = 1.0;           ///< s: it leaps to a frame that is farther ahead of it than that
  static constexpr double kMostTaken = 0.25;     ///< share of the rate by which it is sped up or slowed down, at most

  /// A frame has been completed. @return a piece to be told; nothing within 20 ms of the last one, unless time jumps
  [[nodiscard]] std::optional<SchedulePiece> add_frame(const ClockStamp& now, double time);
  /// Simulated time stops: at the last frame. Nothing where it had stopped, or before the first frame.
  [[nodiscard]] std::optional<SchedulePiece> pause();
  /// It goes on.
  [[nodiscard]] std::optional<SchedulePiece> resume(const ClockStamp& now);

 private:
  struct Point {
    std::int64_t clock_ns;
    double time;
  };
  struct Line {
    double rate;
    double time;  ///< now
  };

  SchedulePiece begin_at(const ClockStamp& now, double time, double rate);
  void keep_point(const ClockStamp& now, double time);
  [[nodiscard]] std::optional<Line> fit(std::int64_t now_ns) const;

  std::deque<Point> points_;
  std::optional<SchedulePiece> piece_;  ///< in force
  std::uint64_t era_ = 0;
  double rate_ = 1.0;  ///< fitted
  double last_time_ = 0.0, ahead_ = kAhead;
  std::int64_t told_ns_ = 0;
  bool paused_ = false;
};

}  // namespace pelagos
