#include "source/skew.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {
namespace {

constexpr std::size_t kMostPictures = 1'000'000, kMostRecent = 10'000;

double part_of(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  const auto index = static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

}  // namespace

void Skew::add(std::int64_t shown_ns, double skew) {
  const double magnitude = std::abs(skew);
  recent_.push_back({shown_ns, magnitude});
  while (recent_.size() > kMostRecent || 1e-9 * static_cast<double>(shown_ns - recent_.front().shown_ns) > kWindow)
    recent_.pop_front();
  if (all_ms_.size() < kMostPictures) all_ms_.push_back(1e3 * magnitude);
}

double Skew::recent(double part) const {
  std::vector<double> values;
  for (const Picture& picture : recent_) values.push_back(picture.magnitude);
  return part_of(std::move(values), part);
}

void SwapForecast::add(double seconds) {
  last_.push_back(seconds);
  if (last_.size() > kMost) last_.pop_front();
}

double SwapForecast::seconds(double part) const { return part_of({last_.begin(), last_.end()}, part); }

}  // namespace pelagos
