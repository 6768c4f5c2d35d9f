#include "simulation/open_water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelagos {

namespace {

constexpr double kClearance = 0.25;  ///< spacings that oil keeps away from bodies
constexpr double kSubstep = 0.2;     ///< spacings: oil at a body goes on in steps of so much
constexpr int kMostSubsteps = 64;
constexpr double kExact = 1e-9;  ///< spacings: a distance counts as kept
constexpr double kProbe = 1e-4;  ///< spacings: half the baseline of a gradient
constexpr int kPushes = 8;
constexpr int kDirections = 64;  ///< of the search from a place that is deep inside; refined between them
constexpr int kRefinements = 24;
constexpr double kFinestMarch = 1e-3;  ///< spacings
constexpr int kMostMarches = 400;
/// A push along the gradient is taken for the shortest way while it is at most so much longer than the depth.
constexpr double kLongestPush = 1.2;
constexpr double kTie = 1e-6;  ///< relative difference below which two ways are equally short

Eigen::Vector2d direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

void OpenWater::distances(const Eigen::Vector2d& place, double limit, std::vector<double>& each) const {
  bodies_.signed_distances({place.x(), place.y(), heights_[0]}, limit, each);
  if (heights_[0] == heights_[1]) return;
  std::vector<double> other;
  bodies_.signed_distances({place.x(), place.y(), heights_[1]}, limit, other);
  for (std::size_t i = 0; i < each.size(); ++i) each[i] = std::min(each[i], other[i]);
}

double OpenWater::distance(const Eigen::Vector2d& place, double limit) const {
  std::vector<double> each;
  distances(place, limit, each);
  return each.empty() ? limit : *std::min_element(each.begin(), each.end());
}

/// Newton's steps along the slope of the distance, back into the patch after each.
std::optional<Eigen::Vector2d> OpenWater::push_off(Eigen::Vector2d place, double clearance) const {
  const double limit = 64.0 * spacing_, h = kProbe * spacing_;
  for (int push = 0; push < kPushes; ++push) {
    place = patch_.keep(place);
    const double lack = clearance - distance(place, limit);
    if (lack <= kExact * spacing_) return place;
    Eigen::Vector2d slope;
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
      slope[axis] = (distance(place + step, limit) - distance(place - step, limit)) / (2.0 * h);
    }
    if (!(slope.squaredNorm() > 1e-2)) return std::nullopt;  // beside a nearly level side, or in the middle between two
    place += lack / slope.squaredNorm() * slope;
  }
  return std::nullopt;
}

Eigen::Vector2d OpenWater::go(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  Eigen::Vector2d place = from, rest = patch_.keep(to) - from;
  const double reach = 2.0 * kClearance * spacing_;
  for (int step = 0; step < kMostSubsteps && rest.norm() > 0.0; ++step) {
    const double room = distance(place, reach + rest.norm());
    if (room < 0.0) return place;
    const double clearance = std::min(room, kClearance * spacing_);
    const double most = std::max({room - clearance, std::min(room, kSubstep * spacing_), 0.02 * spacing_});
    const Eigen::Vector2d part = rest * std::min(1.0, most / rest.norm());
    Eigen::Vector2d next = place + part;
    if (distance(next, reach) < clearance - kExact * spacing_) {
      const auto beside = push_off(next, clearance);
      if (!beside || (*beside - place).norm() > 1.01 * part.norm()) return place;
      next = *beside;
    }
    place = next;
    rest -= part;
  }
  return place;
}

std::optional<double> OpenWater::length_out(const Eigen::Vector2d& place, const Eigen::Vector2d& direction, double most,
                                            const std::vector<std::uint8_t>& within,
                                            const std::function<bool(const Eigen::Vector2d&)>& is_wet) const {
  const double clearance = kClearance * spacing_, limit = 1e3 * spacing_;
  std::vector<double> each;
  double length = 0.0;
  for (int march = 0; march < kMostMarches && length < most; ++march) {
    const Eigen::Vector2d at = place + length * direction;
    if (patch_.keep(at) != at) return std::nullopt;
    distances(at, limit, each);
    double nearest = limit, nearest_other = limit;
    for (std::size_t i = 0; i < each.size(); ++i) {
      nearest = std::min(nearest, each[i]);
      if (within[i] == 0) nearest_other = std::min(nearest_other, each[i]);
    }
    if (nearest_other < 0.0) return std::nullopt;
    if (nearest >= clearance - kFinestMarch * spacing_ && is_wet(at)) return length;
    // No nearer place is free; and no step goes past a body that must not be crossed.
    const double safe = nearest >= clearance ? kClearance * spacing_ : clearance - nearest;
    length += std::max(std::min(safe, nearest_other), kFinestMarch * spacing_);
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> OpenWater::way_out(const Eigen::Vector2d& place, const Eigen::Vector2d& preferred,
                                                  const std::function<bool(const Eigen::Vector2d&)>& is_wet) const {
  const double depth = -distance(place, 1e3 * spacing_);
  for (const double clearance : {kClearance * spacing_, kClearance / 4.0 * spacing_})
    if (const auto beside = push_off(place, clearance))
      if ((*beside - place).norm() <= kLongestPush * (depth + clearance) && is_wet(*beside)) return *beside - place;

  std::vector<double> each;
  distances(place, 1e3 * spacing_, each);
  std::vector<std::uint8_t> within;
  for (const double one : each) within.push_back(one < 0.0 ? 1 : 0);
  constexpr double kStep = 2.0 * std::numbers::pi / kDirections;
  const double first = preferred.isZero(0.0) ? 0.0 : std::atan2(preferred.y(), preferred.x());
  double best = 2.0 * (patch_.max - patch_.min).norm(), angle = 0.0;
  bool found = false;
  for (int k = 0; k < kDirections; ++k) {  // the preferred direction first, then by turns to both sides of it
    const double turned = first + ((k + 1) / 2) * (k % 2 == 0 ? 1.0 : -1.0) * kStep;
    const auto length = length_out(place, direction_of(turned), best, within, is_wet);
    if (!length || *length >= (1.0 - kTie) * best) continue;
    best = *length;
    angle = turned;
    found = true;
  }
  if (!found) return std::nullopt;
  double step = 0.5 * kStep;
  for (int k = 0; k < kRefinements; ++k, step *= 0.5)
    for (const double turned : {angle - step, angle + step}) {
      const auto length = length_out(place, direction_of(turned), best, within, is_wet);
      if (!length || *length >= (1.0 - kTie) * best) continue;
      best = *length;
      angle = turned;
      break;
    }
  return best * direction_of(angle);
}

}  // namespace pelagos
