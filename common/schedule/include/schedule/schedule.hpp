#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace pelagos {

/// From a moment of a steady clock on, simulated time goes along a line, up to a limit.
struct SchedulePiece {
  std::uint64_t era = 0;      ///< goes up where simulated time goes back: frames of two eras do not belong together
  std::int64_t clock_ns = 0;  ///< ns, the steady clock of whoever makes the frames: the piece begins
  std::int64_t utc_ns = 0;    ///< ns since 1970, the system clock of the same machine at the same moment
  double time = 0.0;          ///< s, simulated, at clock_ns
  double rate = 1.0;          ///< simulated seconds in a second, >= 0
  double limit = 0.0;         ///< s, simulated: there it stands still until the next piece begins
};

/// s, simulated. Before the piece begins it is the piece's first time.
[[nodiscard]] double time_at(const SchedulePiece& piece, std::int64_t clock_ns);

/// The schedule at one moment.
struct ScheduledInstant {
  double time = 0.0;  ///< s, simulated
  std::uint64_t era = 0;
  std::int64_t era_begin_ns = 0;  ///< frames of the era were completed from then on, by the schedule's clock;
  std::int64_t era_end_ns = 0;    ///< and before then
};

/// The pieces of the last seconds. Viewers read it at the time now less their delay: a piece that comes within the
/// delay is followed by all of them at the same moment.
class Schedule {
 public:
  static constexpr std::size_t kMostPieces = 128;

  /// Replaces what was known from the piece's moment on, as when time stops at a frame that is already complete.
  void add(const SchedulePiece& piece);
  void clear() { pieces_.clear(); }
  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] const SchedulePiece& newest() const { return pieces_.back().piece; }

  /// Nothing while there is no piece. Before the first one, the first one's.
  [[nodiscard]] std::optional<ScheduledInstant> at(std::int64_t clock_ns) const;

 private:
  struct Entry {
    SchedulePiece piece;
    std::int64_t era_begin_ns;
  };
  std::deque<Entry> pieces_;  ///< the oldest first
};

}  // namespace pelagos
