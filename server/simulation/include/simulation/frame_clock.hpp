#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "values/frame_times.hpp"

namespace pelagos {

/// Simulation time, and when a frame is due: at the multiples of the frame interval.
class FrameClock {
 public:
  FrameClock() = default;  ///< to be read into
  explicit FrameClock(double frame_interval) : interval_(frame_interval) {}

  [[nodiscard]] double time() const { return time_; }           ///< s
  [[nodiscard]] std::uint64_t frame() const { return frame_; }  ///< the last frame reached; 0 at time zero
  [[nodiscard]] double interval() const { return interval_; }

  /// The step to make, never longer than the frame interval. For kEven: what is left to the next frame, cut into equal
  /// steps no longer than `admissible`. For kAtSteps: `admissible`.
  [[nodiscard]] double choose_step(double admissible, FrameTimes times) const {
    if (times == FrameTimes::kAtSteps) return std::min(admissible, interval_);
    const double left = next_frame_time() - time_;
    const double steps = std::max(1.0, std::ceil(left / admissible - 1e-9));
    return left / steps;
  }

  /// Moves on by a step from choose_step. True if the next frame was due in it. For kEven the time is then exactly
  /// frame * interval, for kAtSteps it is less than a step more.
  bool advance(double dt, FrameTimes times) {
    if (times == FrameTimes::kAtSteps) return advance_freely(dt);
    if (time_ + 1.5 * dt < next_frame_time()) {
      time_ += dt;
      return false;
    }
    time_ = next_frame_time();
    ++frame_;
    return true;
  }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("interval", self.interval_);
    visit("time", self.time_);
    visit("frame", self.frame_);
  }

 private:
  bool advance_freely(double dt) {
    time_ += dt;
    if (time_ < next_frame_time() * (1.0 - 1e-12)) return false;
    ++frame_;
    return true;
  }

  [[nodiscard]] double next_frame_time() const { return static_cast<double>(frame_ + 1) * interval_; }

  double interval_ = 1.0;
  double time_ = 0.0;
  std::uint64_t frame_ = 0;
};

}  // namespace pelagos
