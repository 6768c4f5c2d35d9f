#include "source/frame_window.hpp"

#include <algorithm>
#include <cmath>

#include "channels/camera.hpp"

namespace pelagos {
namespace {

/// A body that moves farther than that from frame to frame, and twice as far as its speed says, was put elsewhere.
constexpr double kLeap = 1.0;  // m

bool is_of_era(const OceanFrame& frame, const DueInstant& due) {
  if (!by_server(due.clock))
    return frame.received_ns >= due.scheduled.era_begin_ns && frame.received_ns < due.scheduled.era_end_ns;
  if (!frame.completed_ns) return true;
  return *frame.completed_ns >= due.scheduled.era_begin_ns && *frame.completed_ns < due.scheduled.era_end_ns;
}

const BodyState* find(const OceanFrame& frame, std::uint32_t body) {
  const auto found = std::find_if(frame.bodies.begin(), frame.bodies.end(),
                                  [body](const BodyState& state) { return state.body == body; });
  return found == frame.bodies.end() ? nullptr : &*found;
}

bool leaps(const BodyState& from, const BodyState& to, double seconds) {
  const double fastest = std::max(from.velocity.norm(), to.velocity.norm());
  return (to.position - from.position).norm() > kLeap + 2.0 * seconds * fastest;
}

/// @param part  0 at `from`, 1 at `to`
BodyState between(const BodyState& from, const BodyState& to, double part) {
  BodyState state = part < 0.5 ? from : to;
  state.position = from.position + part * (to.position - from.position);
  state.orientation = from.orientation.slerp(part, to.orientation);
  state.velocity = from.velocity + part * (to.velocity - from.velocity);
  state.angular_velocity = from.angular_velocity + part * (to.angular_velocity - from.angular_velocity);
  return state;
}

}  // namespace

void FrameWindow::add(std::unique_ptr<OceanFrame> frame) {
  if (!frame) return;
  while (!frames_.empty() && (frames_.front().frame->source != frame->source || frames_.size() >= kMostFrames)) drop(0);
  frames_.push_back({std::move(frame)});
}

void FrameWindow::drop(std::size_t index) {
  Entry& entry = frames_[index];
  if (!entry.drawn) ++never_drawn_;
  if (entry.frame.get() == last_drawn_) last_drawn_ = nullptr;
  recycle_(std::move(entry.frame));
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(index));
}

FramePair FrameWindow::without_due() {
  FramePair pair;
  if (frames_.empty()) return pair;
  pair.before = pair.nearer = last_drawn_ != nullptr ? last_drawn_ : frames_.back().frame.get();
  pair.time = pair.nearer->simulation_time;
  pair.held = true;
  return pair;
}

FramePair FrameWindow::show(const std::optional<DueInstant>& due) {
  FramePair pair;
  if (due) {
    for (const Entry& entry : frames_) {
      const OceanFrame* frame = entry.frame.get();
      if (!is_of_era(*frame, *due)) continue;
      const bool later = frame->simulation_time > due->scheduled.time;
      const OceanFrame*& best = later ? pair.after : pair.before;
      // Of two frames of the same time the one that came last.
      if (best == nullptr ||
          (later ? frame->simulation_time <= best->simulation_time : frame->simulation_time >= best->simulation_time))
        best = frame;
    }
  } else {
    last_drawn_ = nullptr;
  }
  if (pair.before == nullptr && pair.after == nullptr) {
    pair = without_due();
  } else {
    const double time = due->scheduled.time;
    const bool first = pair.after == nullptr || (pair.before != nullptr && time - pair.before->simulation_time <=
                                                                               pair.after->simulation_time - time);
    pair.nearer = first ? pair.before : pair.after;
    pair.time = std::clamp(time, pair.nearer->simulation_time - kLongestExtrapolation,
                           pair.nearer->simulation_time + kLongestExtrapolation);
    pair.held = pair.time != time;
  }
  last_drawn_ = pair.nearer;
  for (std::size_t i = frames_.size(); i-- > 0;) {
    const OceanFrame* frame = frames_[i].frame.get();
    if (frame == pair.nearer) frames_[i].drawn = true;
    if (frame == pair.before || frame == pair.after || frame == pair.nearer || !due) continue;
    const bool earlier =
        pair.before != nullptr && is_of_era(*frame, *due) && frame->simulation_time <= pair.before->simulation_time;
    const bool of_earlier_era = by_server(due->clock)
                                    ? frame->completed_ns && *frame->completed_ns < due->scheduled.era_begin_ns
                                    : frame->received_ns < due->scheduled.era_begin_ns;
    if (earlier || of_earlier_era) drop(i);
  }
  return pair;
}

std::vector<BodyState> bodies_at(const FramePair& pair) {
  std::vector<BodyState> bodies;
  if (pair.nearer == nullptr) return bodies;
  const bool both = pair.before != nullptr && pair.after != nullptr;
  const double seconds = both ? pair.after->simulation_time - pair.before->simulation_time : 0.0;
  for (const BodyState& body : pair.nearer->bodies) {
    const BodyState* from = both ? find(*pair.before, body.body) : nullptr;
    const BodyState* to = both ? find(*pair.after, body.body) : nullptr;
    const bool on_line = from != nullptr && to != nullptr && seconds > 0.0 && !leaps(*from, *to, seconds);
    bodies.push_back(on_line ? between(*from, *to, (pair.time - pair.before->simulation_time) / seconds)
                             : extrapolate(body, pair.time - pair.nearer->simulation_time));
  }
  return bodies;
}

}  // namespace pelagos
