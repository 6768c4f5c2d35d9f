#include "client/frame_count.hpp"

#include <utility>

namespace pelagos {

FrameOrder FrameCount::count(std::uint64_t frame, std::int64_t wall_time_ns) {
  const std::optional<Stamp> last = std::exchange(last_, Stamp{frame, wall_time_ns});
  if (!last) return FrameOrder::kNext;
  if (frame == last->frame && wall_time_ns == last->wall_time_ns) return FrameOrder::kRepeated;
  if (frame > last->frame && frame - last->frame - 1 <= kLargestGap) {
    missed_ += frame - last->frame - 1;
    return FrameOrder::kNext;
  }
  ++jumps_;
  return FrameOrder::kJump;
}

}  // namespace pelagos
