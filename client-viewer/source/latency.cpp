#include "source/latency.hpp"

#include <algorithm>

namespace pelagos {

namespace {

constexpr std::size_t kMostSamples = 1'000'000;
constexpr double kLongestWayMs = 2000.0;

}  // namespace

void Latency::add(const OceanFrame& frame, std::chrono::steady_clock::time_point drawn, std::int64_t system_now_ns) {
  if (from_server_.size() >= kMostSamples) return;
  // In double: the difference of a stranger's number and ours may not fit into 64 bits.
  const double since_made = 1e-6 * (static_cast<double>(system_now_ns) - static_cast<double>(frame.wall_time_ns));
  const double since_arrival = std::chrono::duration<double, std::milli>(drawn - frame.received).count();
  const double way = since_made - since_arrival;
  quickest_ms_ = from_server_.empty() ? way : std::min(quickest_ms_, way);
  from_server_.push_back(since_made);
  from_arrival_.push_back(since_arrival);
}

std::optional<double> Latency::clock_difference() const {
  if (from_server_.empty()) return std::nullopt;
  const bool agree = quickest_ms_ >= 0.0 && quickest_ms_ < kLongestWayMs;
  return agree ? 0.0 : 1e-3 * quickest_ms_;
}

std::vector<double> Latency::from_server() const {
  return clock_difference() == 0.0 ? from_server_ : std::vector<double>();
}

}  // namespace pelagos
