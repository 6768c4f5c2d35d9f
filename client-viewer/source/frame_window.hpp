#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "client/frame_receiver.hpp"

namespace pelagos {

/// The frames around an instant, and the instant that can be drawn from them.
struct FramePair {
  const OceanFrame* before = nullptr;  ///< the last one that is not later than the instant; null: there is none
  const OceanFrame* after = nullptr;   ///< the first one that is later; likewise
  const OceanFrame* nearer = nullptr;  ///< of both; null: there is no frame at all
  double time = 0.0;                   ///< s, simulated: what is due, or as near to it as frames allow
  bool held = false;                   ///< it is not what is due
};

/// The last frames of a server, from which the instant that is due is drawn. Times beyond the frames are drawn from the
/// last or first of them by its velocities, for at most kLongestExtrapolation; there the picture holds.
class FrameWindow {
 public:
  static constexpr double kLongestExtrapolation = 0.2;  ///< s
  static constexpr std::size_t kMostFrames = 24;
  using Recycle = std::function<void(std::unique_ptr<OceanFrame>)>;

  /// @param recycle  gets the frames that are of no use any more
  explicit FrameWindow(Recycle recycle) : recycle_(std::move(recycle)) {}

  /// One of another server replaces all. Null is ignored.
  void add(std::unique_ptr<OceanFrame> frame);
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  [[nodiscard]] const OceanFrame& newest() const { return *frames_.back().frame; }

  /// Lets frames go that are earlier than the instant needs. Where nothing is due, or no frame is of the era that is
  /// due, the last one drawn stays, or the newest is drawn. Pointers hold until the next call.
  [[nodiscard]] FramePair show(const std::optional<DueInstant>& due);
  [[nodiscard]] std::uint64_t never_drawn() const { return never_drawn_; }

 private:
  struct Entry {
    std::unique_ptr<OceanFrame> frame;
    bool drawn = false;
  };
  void drop(std::size_t index);
  [[nodiscard]] FramePair without_due() const;
  [[nodiscard]] FramePair around(const DueInstant& due) const;
  void let_go(const FramePair& pair, const DueInstant& due);

  Recycle recycle_;
  std::deque<Entry> frames_;  ///< in the order of their arrival
  const OceanFrame* last_drawn_ = nullptr;
  std::uint64_t never_drawn_ = 0;
};

/// The bodies of the nearer frame at the pair's time: on a straight line between both frames, turned evenly. A body
/// that only one frame has, or that leaps between them, goes by its own velocities.
[[nodiscard]] std::vector<BodyState> bodies_at(const FramePair& pair);

}  // namespace pelagos
