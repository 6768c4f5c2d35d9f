#include "schedule/schedule_fit.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace pelagos {

namespace {

constexpr std::int64_t kLeastGapNs = 20'000'000;  // between points, and between pieces
constexpr std::size_t kLeastPoints = 3;           // that stay, however old
constexpr double kTimeConstant = 1.0;             // s, in which the schedule comes to the fit
constexpr double kLeastTaken = 0.02;              // simulated seconds in a second
constexpr double kLongestAhead = 2.0;             // s
constexpr double kFramesAhead = 1.25;             // intervals of frames
constexpr double kClockAhead = 0.1;               // s, by the clock

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * (static_cast<double>(to_ns) - static_cast<double>(from_ns));
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

SchedulePiece ScheduleFit::begin_at(const ClockStamp& now, double time, double rate) {
  told_ns_ = now.clock_ns;
  const double ahead = std::max(ahead_, kClockAhead * rate_);
  piece_ = SchedulePiece{era_, now.clock_ns, now.utc_ns, time, rate, paused_ ? time : last_time_ + ahead};
  return *piece_;
}

void ScheduleFit::keep_point(const ClockStamp& now, double time) {
  if (!points_.empty() && now.clock_ns - points_.back().clock_ns < kLeastGapNs) return;
  points_.push_back({now.clock_ns, time});
  const auto too_old = [&] {
    return points_.size() > kLeastPoints && seconds_between(points_.front().clock_ns, now.clock_ns) > kLongestWindow;
  };
  while (points_.size() > kMostPoints || too_old()) points_.pop_front();
}

std::optional<ScheduleFit::Line> ScheduleFit::fit(std::int64_t now_ns) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (std::size_t j = i + 1; j < points_.size(); ++j)
      values.push_back((points_[j].time - points_[i].time) / seconds_between(points_[i].clock_ns, points_[j].clock_ns));
  if (values.empty()) return std::nullopt;
  const double rate = std::max(median(values), 0.0);
  values.clear();
  for (const Point& point : points_) values.push_back(point.time + rate * seconds_between(point.clock_ns, now_ns));
  return Line{rate, median(values)};
}

std::optional<SchedulePiece> ScheduleFit::add_frame(const ClockStamp& now, double time) {
  const bool first = !piece_, back = piece_ && time < last_time_;
  if (piece_ && time == last_time_ && !paused_) return std::nullopt;
  if (piece_ && !back) ahead_ = std::clamp(kFramesAhead * (time - last_time_), kAhead, kLongestAhead);
  last_time_ = time;
  if (first || back) ++era_;
  const double shown = piece_ ? time_at(*piece_, now.clock_ns) : time;
  if (first || back || paused_ || time - shown > kJump) {
    points_.clear();
    keep_point(now, time);
    return begin_at(now, time, paused_ ? 0.0 : rate_);
  }
  keep_point(now, time);
  if (now.clock_ns - told_ns_ < kLeastGapNs) return std::nullopt;
  double rate = rate_;
  if (const std::optional<Line> line = fit(now.clock_ns)) {
    rate_ = line->rate;
    const double most = std::max(kMostTaken * rate_, kLeastTaken);
    rate = std::max(rate_ + std::clamp((line->time - shown) / kTimeConstant, -most, most), 0.0);
  }
  return begin_at(now, shown, rate);
}

std::optional<SchedulePiece> ScheduleFit::pause() {
  if (std::exchange(paused_, true) || !piece_) return std::nullopt;
  // The same line, which now ends at the last frame. It ended there already where the schedule was ahead of it: so
  // viewers, which are behind, do not go back.
  piece_->limit = last_time_;
  if (piece_->time > last_time_) piece_->time = last_time_;
  return piece_;
}

std::optional<SchedulePiece> ScheduleFit::resume(const ClockStamp& now) {
  if (!std::exchange(paused_, false) || !piece_) return std::nullopt;
  points_.clear();
  return begin_at(now, time_at(*piece_, now.clock_ns), rate_);
}

}  // namespace pelagos
