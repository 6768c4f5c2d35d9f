#include "renderer/bow_spray.hpp"

#include <algorithm>
#include <cmath>

#include "scales/scales.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr double kLongestGap = 2.0;     // s
constexpr double kLeastForce = 0.02;    // less throws nothing
constexpr double kDrag = 0.6;           // 1/s, of clusters in the air
constexpr double kLeeway = 0.35;        // share of the wind's speed that drag works towards
constexpr double kMostOfABurst = 22.0;  // clusters on each side

std::int64_t tick_of(double time) { return static_cast<std::int64_t>(std::floor(time / BowSpray::kTick)); }

/// Places about the forward part of a hull, as wake.glsl has her waterline.
Eigen::Vector2d on_waterline(const MovingHull& hull, double aft_of_stem, double side) {
  const double along = 0.97 - aft_of_stem;
  const double fore = std::clamp((along - 0.15) / 0.80, 0.0, 1.0);
  const Eigen::Vector2d to_port(-hull.way.y(), hull.way.x());
  return hull.place + along * hull.half_length * hull.way +
         side * (hull.half_beam * (1.0 - fore * fore) + 0.25) * to_port;
}

/// One cluster of a burst, `age` seconds after it was thrown.
SprayCluster cluster_of(const MovingHull& hull, double force, double side, double age, double level,
                        const Eigen::Vector2d& wind, SplitMix64& random) {
  const double aft = 0.34 * random.next_unit() * random.next_unit(), out = random.next_unit(), up = random.next_unit(),
               big = random.next_unit();
  const Eigen::Vector2d start = on_waterline(hull, aft, side), to_port(-hull.way.y(), hull.way.x());
  const double slam = std::max(hull.slam, 0.0);
  // A sheet that the flare of the bow turns outwards; it keeps some of the ship's speed.
  const double outwards = (0.5 + 0.22 * hull.speed + 0.9 * slam) * (0.45 + 0.75 * out);
  const double upwards = (0.8 + 0.28 * hull.speed + 1.5 * slam) * (0.25 + 0.75 * up * up);
  Eigen::Vector3d thrown;
  thrown << (0.25 + 0.4 * big) * hull.speed * hull.way + side * outwards * to_port, upwards;
  Eigen::Vector3d carried;
  carried << kLeeway * wind, -kStandardGravity / kDrag;  // what drag and gravity would bring it to
  const double slowed = std::exp(-kDrag * age), way = (1.0 - slowed) / kDrag;
  SprayCluster cluster;
  cluster.place << start, level + hull.bow_water + 0.1;
  cluster.place += way * thrown + (age - way) * carried;
  cluster.velocity = slowed * thrown + (1.0 - slowed) * carried;
  cluster.size =
      (0.4 + 0.9 * big) * (0.5 + 0.7 * force) * std::clamp(hull.half_beam / 4.0, 0.3, 1.6) * (0.6 + 0.6 * age);
  cluster.strength = std::min(0.35 + 0.65 * force, 1.0) * std::clamp(1.6 - 1.6 * age / BowSpray::kLife, 0.0, 1.0);
  return cluster;
}

}  // namespace

double bow_force(double speed, double slam) {
  const double steady = 0.5 * std::pow(std::clamp((speed - 2.5) / 7.5, 0.0, 1.0), 1.5);
  const double way = std::clamp(0.3 + speed / 5.0, 0.0, 1.0);  // without way the water is pressed aside, not thrown
  return std::clamp(steady + way * std::pow(std::clamp((slam - 0.8) / 3.5, 0.0, 1.0), 1.3), 0.0, 1.0);
}

void BowSpray::throw_up(std::int64_t tick, const MovingHull& hull) {
  const double force = bow_force(hull.speed, hull.slam);
  if (force >= kLeastForce) bursts_.push_back({tick, hull, force});
}

void BowSpray::advance(double time, std::span<const MovingHull> hulls) {
  const bool anew = time < shown_ - 1.0 || time > shown_ + kLongestGap;
  if (anew) {
    bursts_.clear();
    last_.clear();
    shown_ = time - kLife;
  }
  const double since = time - shown_;
  if (since <= 0.0) return;
  for (std::int64_t tick = tick_of(shown_) + 1; tick <= tick_of(time); ++tick) {
    const double before = time - static_cast<double>(tick) * kTick;  // s
    for (const MovingHull& hull : hulls) {
      const auto last = last_.find(hull.body);
      MovingHull then = hull;
      if (last != last_.end())
        then = between(last->second, hull, 1.0 - before / since);
      else
        then.place -= before * hull.speed * hull.way;
      throw_up(tick, then);
    }
  }
  last_.clear();
  for (const MovingHull& hull : hulls) last_[hull.body] = hull;
  shown_ = time;
  while (!bursts_.empty() && static_cast<double>(bursts_.front().tick) * kTick < time - kLife) bursts_.pop_front();
}

std::vector<SprayCluster> BowSpray::clusters(double time, double level, const Eigen::Vector2d& wind) const {
  std::vector<SprayCluster> clusters;
  for (const Burst& burst : bursts_) {
    const double age = time - static_cast<double>(burst.tick) * kTick;
    if (age < 0.0) continue;
    const int count = static_cast<int>(std::lround(1.0 + kMostOfABurst * burst.force));
    SplitMix64 random(static_cast<std::uint64_t>(burst.tick) * 0x9e3779b97f4a7c15U + burst.hull.body);
    for (int i = 0; i < 2 * count && clusters.size() < kMost; ++i) {
      const SprayCluster one = cluster_of(burst.hull, burst.force, i % 2 == 0 ? 1.0 : -1.0, age, level, wind, random);
      const bool down = one.velocity.z() < 0.0 && one.place.z() < level + burst.hull.bow_water - 0.3;
      if (!down && one.strength > 0.01) clusters.push_back(one);
    }
  }
  return clusters;
}

}  // namespace pelagos
