#pragma once

#include <algorithm>
#include <chrono>

namespace pelagos {

/// Time in which a process listened, for silence to be measured by. It goes with the steady clock while somebody looks
/// often. A longer stretch without a look counts as kLongest: the process was stopped or had no processor, so nobody
/// else was silent.
class ListeningTime {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kLongest{500};

  explicit ListeningTime(Clock::time_point now) : looked_(now), listened_(now) {}

  /// Somebody looks at what has come. @return the time to compare with that of other looks
  Clock::time_point look(Clock::time_point now) {
    listened_ += std::min<Clock::duration>(now - looked_, kLongest);
    looked_ = now;
    return listened_;
  }
  [[nodiscard]] Clock::time_point at_last_look() const { return listened_; }

 private:
  Clock::time_point looked_, listened_;
};

}  // namespace pelagos
