#include "schedule/clock_offset.hpp"

#include <algorithm>
#include <initializer_list>

namespace pelagos {

bool ClockOffsetFilter::add(const ClockStamps& stamps) {
  for (const std::int64_t stamp : {stamps.asked, stamps.received, stamps.answered, stamps.returned})
    if (stamp > kMostNs || stamp < -kMostNs) return false;
  const std::int64_t away = stamps.returned - stamps.asked, there = stamps.answered - stamps.received;
  if (away < 0 || there < 0 || there > away || 1e-9 * static_cast<double>(away) > kLongestWay) return false;
  // Each difference fits into 64 bits; half of each, so that the sum does too.
  const std::int64_t out = stamps.received - stamps.asked, back = stamps.answered - stamps.returned;
  answers_.push_back(
      {stamps.returned, out / 2 + back / 2 + (out % 2 + back % 2) / 2, 1e-9 * static_cast<double>(away - there)});
  if (answers_.size() > kMostAnswers) answers_.pop_front();
  return true;
}

std::optional<ClockOffset> ClockOffsetFilter::offset(std::int64_t now_ns) const {
  std::optional<ClockOffset> best;
  std::size_t count = 0;
  for (const Answer& answer : answers_) {
    const double age = std::max(1e-9 * (static_cast<double>(now_ns) - static_cast<double>(answer.returned_ns)), 0.0);
    if (age > kLongestAge) continue;
    ++count;
    const double error = 0.5 * answer.way + kMostDrift * age;
    if (!best || error < best->error)
      best = ClockOffset{1e-9 * static_cast<double>(answer.offset_ns), answer.offset_ns, error, 0};
  }
  if (best) best->answers = count;
  return best;
}

}  // namespace pelagos
