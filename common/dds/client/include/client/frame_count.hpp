#pragma once

#include <cstdint>
#include <optional>

namespace pelagos {

/// How a frame follows the one before.
enum class FrameOrder {
  kNext,      ///< the first one, or a later number; numbers between were missed
  kRepeated,  ///< the same frame again: a server repeats its last one while nothing moves
  kJump,      ///< an earlier number, or one so much later that nobody can have missed all between
};

/// Counts missed frames of one server by gaps in their numbers.
class FrameCount {
 public:
  /// Frames of about an hour: a larger gap is a jump and not counted as frames missed.
  static constexpr std::uint64_t kLargestGap = 100'000;

  /// @param wall_time_ns  of the frame: one that is made again under the same number is no repetition
  [[nodiscard]] FrameOrder count(std::uint64_t frame, std::int64_t wall_time_ns);
  [[nodiscard]] std::uint64_t missed() const { return missed_; }
  [[nodiscard]] std::uint64_t jumps() const { return jumps_; }
  /// The next frame is of another server.
  void restart() { last_.reset(); }

 private:
  struct Stamp {
    std::uint64_t frame;
    std::int64_t wall_time_ns;
  };
  std::optional<Stamp> last_;
  std::uint64_t missed_ = 0, jumps_ = 0;
};

}  // namespace pelagos
