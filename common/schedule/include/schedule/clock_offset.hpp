#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace pelagos {

/// The four stamps of a question and its answer between two steady clocks, ns.
struct ClockStamps {
  std::int64_t asked = 0;     ///< here
  std::int64_t received = 0;  ///< there
  std::int64_t answered = 0;  ///< there
  std::int64_t returned = 0;  ///< here
};

/// By how much another clock is ahead of the one here.
struct ClockOffset {
  double seconds = 0.0;     ///< s, there less here; hours or years where the clocks count from different moments
  std::int64_t ns = 0;      ///< the same
  double error = 0.0;       ///< s: it lies within that of the truth, however unequal the ways there and back
  std::size_t answers = 0;  ///< that it was chosen from
};

/// Measures the offset between two clocks as NTP does (RFC 5905): ((received - asked) + (answered - returned)) / 2,
/// from the answer that took the shortest way there and back. Of older answers the way counts longer by 50 us for each
/// second of their age, since clocks drift apart.
class ClockOffsetFilter {
 public:
  static constexpr std::size_t kMostAnswers = 16;
  static constexpr double kLongestWay = 2.0;                          ///< s, there and back; slower answers are refused
  static constexpr double kLongestAge = 120.0;                        ///< s
  static constexpr double kMostDrift = 50e-6;                         ///< s in a second, of two clocks
  static constexpr std::int64_t kMostNs = 4'000'000'000'000'000'000;  ///< of a stamp, either sign

  /// @return false for an answer that cannot be: it came before it was asked for, took longer than kLongestWay, was
  /// answered before it was received, or has stamps beyond kMostNs
  bool add(const ClockStamps& stamps);
  void clear() { answers_.clear(); }
  /// @param now_ns  by the clock here. Nothing while no answer of the last kLongestAge is known
  [[nodiscard]] std::optional<ClockOffset> offset(std::int64_t now_ns) const;

 private:
  struct Answer {
    std::int64_t returned_ns;
    std::int64_t offset_ns;
    double way;  ///< s
  };
  std::deque<Answer> answers_;
};

}  // namespace pelagos
