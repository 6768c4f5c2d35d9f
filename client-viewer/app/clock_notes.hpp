#pragma once

#include <cstdint>
#include <optional>

#include "app/presentation.hpp"
#include "source/frame_source.hpp"

namespace pelagos {

/// Tells on stderr by which clock pictures are drawn when that changes, warns where channels on several machines may
/// not show the same instant, and where pictures miss the instant that is due.
class ClockNotes {
 public:
  explicit ClockNotes(FrameSource& source) : source_(source) {}

  /// After a picture; quick.
  void look(const Presentation& view);

 private:
  void tell_clock(const ClockState& state);
  void warn_of_arrival(const Presentation& view, std::int64_t now_ns);
  void compare_host(const ClockState& state);
  void tell_skew(const Presentation& view);

  FrameSource& source_;
  std::optional<std::int64_t> first_ns_;
  std::int64_t looked_ns_ = 0, told_skew_ns_ = 0;
  ViewerClock told_ = ViewerClock::kNone;
  bool warned_of_arrival_ = false, warned_of_host_ = false;
};

}  // namespace pelagos
