#include "source/frame_window.hpp"

#include <algorithm>
#include <cmath>

#include "channels/camera.hpp"

namespace pelagos {
namespace {

/// A body that moves farther than that from frame to frame, and twice as far as its speed says, was put elsewhere.
constexpr double kLeap = 1.0;  // m

/// When the frame was completed, or came, by the clock of the schedule; nothing where that is not known.
std::optional<std::int64_t> stamp_of(const OceanFrame& frame, const DueInstant& due) {
  return by_server(due.clock) ? frame.completed_ns : std::optional(frame.received_ns);
}

bool is_of_earlier_era(const OceanFrame& frame, const DueInstant& due) {
  const auto stamp = stamp_of(frame, due);
  return stamp && *stamp < due.scheduled.era_begin_ns;
}

bool is_of_era(const OceanFrame& frame, const DueInstant& due) {
  const auto stamp = stamp_of(frame, due);
  return !stamp || (*stamp >= due.scheduled.era_begin_ns && *stamp < due.scheduled.era_end_ns);
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

FramePair FrameWindow::without_due() const {
  FramePair pair;
  if (frames_.empty()) return pair;
  pair.before = pair.nearer = last_drawn_ != nullptr ? last_drawn_ : frames_.back().frame.get();
  pair.time = pair.nearer->simulation_time;
  pair.held = true;
  return pair;
}

/// Of two frames of the same time the one that came last.
FramePair FrameWindow::around(const DueInstant& due) const {
  FramePair pair;
  const double time = due.scheduled.time;
  for (const Entry& entry : frames_) {
    const OceanFrame* frame = entry.frame.get();
    if (!is_of_era(*frame, due)) continue;
    if (frame->simulation_time <= time) {
      if (!pair.before || frame->simulation_time >= pair.before->simulation_time) pair.before = frame;
    } else if (!pair.after || frame->simulation_time <= pair.after->simulation_time) {
      pair.after = frame;
    }
  }
  if (!pair.before && !pair.after) return without_due();
  const bool first =
      !pair.after || (pair.before && time - pair.before->simulation_time <= pair.after->simulation_time - time);
  pair.nearer = first ? pair.before : pair.after;
  pair.time = std::clamp(time, pair.nearer->simulation_time - kLongestExtrapolation,
                         pair.nearer->simulation_time + kLongestExtrapolation);
  pair.held = pair.time != time;
  return pair;
}

FramePair FrameWindow::show(const std::optional<DueInstant>& due) {
  if (!due) last_drawn_ = nullptr;
  const FramePair pair = due ? around(*due) : without_due();
  last_drawn_ = pair.nearer;
  for (Entry& entry : frames_)
    if (entry.frame.get() == pair.nearer) entry.drawn = true;
  if (due) let_go(pair, *due);
  return pair;
}

/// Schedules do not go back within an era.
void FrameWindow::let_go(const FramePair& pair, const DueInstant& due) {
  for (std::size_t i = frames_.size(); i-- > 0;) {
    const OceanFrame* frame = frames_[i].frame.get();
    if (frame == pair.before || frame == pair.after || frame == pair.nearer) continue;
    const bool passed = pair.before && is_of_era(*frame, due) && frame->simulation_time <= pair.before->simulation_time;
    if (passed || is_of_earlier_era(*frame, due)) drop(i);
  }
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
