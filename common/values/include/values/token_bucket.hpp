#pragma once

#include <algorithm>
#include <chrono>

namespace pelagos {

/// So many a second, with some at once: the limit of what somebody outside may ask.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;
  TokenBucket(double per_second, double burst) : per_second_(per_second), burst_(burst), tokens_(burst) {}

  /// Adds what has come since the last call. @return whether there are so many
  [[nodiscard]] bool has(Clock::time_point now, double count = 1.0) {
    tokens_ = filled(now);
    last_ = now;
    return tokens_ >= count;
  }
  /// May leave a debt, where the cost is known only afterwards.
  void spend(double count = 1.0) { tokens_ -= count; }
  [[nodiscard]] bool take(Clock::time_point now, double count = 1.0) {
    if (!has(now, count)) return false;
    spend(count);
    return true;
  }
  /// Whether nobody has asked for a while.
  [[nodiscard]] bool full(Clock::time_point now) const { return filled(now) >= burst_; }

 private:
  [[nodiscard]] double filled(Clock::time_point now) const {
    return std::min(burst_, tokens_ + per_second_ * std::chrono::duration<double>(now - last_).count());
  }

  double per_second_, burst_, tokens_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace pelagos
