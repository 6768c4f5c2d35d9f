#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pelagos {

/// Simulation time that lands exactly on multiples of the frame interval, whatever steps lead there.
class FrameClock {
 public:
  FrameClock() = default;  ///< to be read into
  explicit FrameClock(double frame_interval) : interval_(frame_interval) {}

  [[nodiscard]] double time() const { return time_; }           ///< s
  [[nodiscard]] std::uint64_t frame() const { return frame_; }  ///< the last frame reached; 0 at time zero
  [[nodiscard]] double interval() const { return interval_; }

  /// The step to make: what is left to the next frame, cut into equal steps no longer than `admissible`.
  [[nodiscard]] double choose_step(double admissible) const {
    const double left = next_frame_time() - time_;
    const double steps = std::max(1.0, std::ceil(left / admissible - 1e-9));
    return left / steps;
  }

  /// Moves on by a step from choose_step. True if that reached the next frame: the time is then exactly
  /// frame * interval.
  bool advance(double dt) {
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
  [[nodiscard]] double next_frame_time() const { return static_cast<double>(frame_ + 1) * interval_; }

  double interval_ = 1.0;
  double time_ = 0.0;
  std::uint64_t frame_ = 0;
};

}  // namespace pelagos
