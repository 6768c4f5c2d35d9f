#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace pelagos {

/// How far pictures are off the schedule: (simulated time drawn) - (what was due when the picture was shown), s.
class Skew {
 public:
  static constexpr double kWindow = 10.0;  ///< s

  /// @param shown_ns  when, by the steady clock here
  void add(std::int64_t shown_ns, double skew);
  /// Of the magnitudes over the last kWindow; 0 without a picture. @param part  0.5: the median
  [[nodiscard]] double recent(double part) const;
  /// Magnitudes since the start, in ms; at most a million.
  [[nodiscard]] const std::vector<double>& all_ms() const { return all_ms_; }

 private:
  struct Picture {
    std::int64_t shown_ns;
    double magnitude;
  };
  std::deque<Picture> recent_;
  std::vector<double> all_ms_;
};

/// When the picture that is begun now will be shown: in as long as the last ones took.
class SwapForecast {
 public:
  static constexpr std::size_t kMost = 64;  ///< pictures that are looked back at

  void add(double seconds);
  /// s. The part of the last pictures that took no longer: 0.5 for the middle one, 1 for the longest.
  [[nodiscard]] double seconds(double part) const;

 private:
  std::deque<double> last_;
};

}  // namespace pelagos
