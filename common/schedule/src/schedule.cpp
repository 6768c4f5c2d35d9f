#include "schedule/schedule.hpp"

#include <algorithm>
#include <limits>

namespace pelagos {

namespace {

constexpr std::int64_t kAlways = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

}  // namespace

double time_at(const SchedulePiece& piece, std::int64_t clock_ns) {
  // In double: the difference of a stranger's number and ours may not fit into 64 bits.
  const double since = 1e-9 * (static_cast<double>(clock_ns) - static_cast<double>(piece.clock_ns));
  const double time = piece.time + piece.rate * std::max(since, 0.0);
  return std::min(time, std::max(piece.limit, piece.time));
}

void Schedule::add(const SchedulePiece& piece) {
  while (!pieces_.empty() && pieces_.back().piece.clock_ns >= piece.clock_ns) pieces_.pop_back();
  std::int64_t era_begin = kAlways;
  if (!pieces_.empty())
    era_begin = pieces_.back().piece.era == piece.era ? pieces_.back().era_begin_ns : piece.clock_ns;
  pieces_.push_back({piece, era_begin});
  if (pieces_.size() > kMostPieces) pieces_.pop_front();
}

std::optional<ScheduledInstant> Schedule::at(std::int64_t clock_ns) const {
  if (pieces_.empty()) return std::nullopt;
  auto next =
      std::find_if(pieces_.begin(), pieces_.end(), [&](const Entry& entry) { return entry.piece.clock_ns > clock_ns; });
  const Entry& entry = next == pieces_.begin() ? *next : *std::prev(next);
  const auto end =
      std::find_if(next, pieces_.end(), [&](const Entry& other) { return other.piece.era != entry.piece.era; });
  return ScheduledInstant{time_at(entry.piece, clock_ns), entry.piece.era, entry.era_begin_ns,
                          end == pieces_.end() ? kNever : end->piece.clock_ns};
}

}  // namespace pelagos
