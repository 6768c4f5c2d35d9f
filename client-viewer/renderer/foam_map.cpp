#include "renderer/foam_map.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {
namespace {

constexpr int kSide = FoamLevel::kSide;
constexpr std::array<double, kFoamLevels> kTexels = {0.5, 2.5};  // m
constexpr std::int64_t kWindowStep = 16;                         // texels
constexpr double kRenewal = 600.0;                               // s: then the texels' numbers are scaled anew
constexpr double kWashSpeed = 5.0;                               // m/s
constexpr double kLeastSpeed = 0.5;                              // m/s: slower hulls leave nothing
constexpr double kFastest = 40.0;                                // m/s: a body that goes farther was put elsewhere
// The wake widens as it ages: what is laid down again so many seconds later, so much wider.
struct Widening {
  double age, width;
};
constexpr std::array<Widening, 4> kWidenings = {{{0.0, 0.72}, {3.0, 0.95}, {10.0, 1.3}, {30.0, 1.8}}};
constexpr double kAssumedPast = 150.0, kAssumedStep = 0.4;  // s
constexpr double kLongestHull = 300.0, kWidestHull = 40.0;  // m, half of it
constexpr float kLeastFoam = 0.16F;                         // of a particle

using Area = FoamLevel::Area;

/// Texels whose middles lie within a box (m, lattice) and the window.
Area area_of(const FoamLevel& level, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  Area area;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    area.low[axis] = std::max(level.first[axis], static_cast<std::int64_t>(std::floor(low[i] / level.texel)));
    area.high[axis] =
        std::min(level.first[axis] + kSide, static_cast<std::int64_t>(std::floor(high[i] / level.texel)) + 1);
  }
  return area;
}

/// The texels of a row of `area` that lie within `reach` (m) of a line through `from` along the unit vector `along`.
std::pair<std::int64_t, std::int64_t> across_row(const FoamLevel& level, const Area& area, const Eigen::Vector2d& from,
                                                 const Eigen::Vector2d& along, double reach, std::int64_t y) {
  if (std::abs(along.y()) < 1e-3) return {area.low[0], area.high[0]};
  const double up = (static_cast<double>(y) + 0.5) * level.texel - from.y();
  const double middle = from.x() + along.x() * up / along.y(), half = reach / std::abs(along.y());
  const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / level.texel)); };
  return {std::max(area.low[0], index(middle - half)), std::min(area.high[0], index(middle + half) + 1)};
}

void mark(FoamLevel& level, const Area& area) {
  if (area.empty()) return;
  if (level.changed.empty()) {
    level.changed = area;
    return;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    level.changed.low[axis] = std::min(level.changed.low[axis], area.low[axis]);
    level.changed.high[axis] = std::max(level.changed.high[axis], area.high[axis]);
  }
}

void mark_all(FoamLevel& level) { level.changed = {level.first, {level.first[0] + kSide, level.first[1] + kSide}}; }

Eigen::Vector2d middle_of(const FoamLevel& level, std::int64_t x, std::int64_t y) {
  return level.texel * Eigen::Vector2d(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
}

/// Moves a level's window; what comes into it is empty.
void move_to(FoamLevel& level, const std::array<std::int64_t, 2>& first) {
  if (first == level.first) return;
  const std::array<std::int64_t, 2> old = level.first;
  level.first = first;
  for (std::int64_t y = first[1]; y < first[1] + kSide; ++y) {
    const bool row_stays = y >= old[1] && y < old[1] + kSide;
    for (std::int64_t x = first[0]; x < first[0] + kSide; ++x)
      if (!row_stays || x < old[0] || x >= old[0] + kSide) level.at(x, y) = {};
  }
  mark_all(level);
}

Eigen::Vector2d to_port(const Eigen::Vector2d& way) { return {-way.y(), way.x()}; }

}  // namespace

MovingHull between(const MovingHull& a, const MovingHull& b, double share) {
  MovingHull hull = b;
  hull.place = a.place + share * (b.place - a.place);
  const Eigen::Vector2d way = a.way + share * (b.way - a.way);
  if (way.norm() > 1e-3) hull.way = way.normalized();
  hull.speed = std::lerp(a.speed, b.speed, share);
  hull.slam = std::lerp(a.slam, b.slam, share);
  hull.bow_water = std::lerp(a.bow_water, b.bow_water, share);
  return hull;
}

namespace {

/// The nearest, at most kMostHulls, with sizes of ships.
std::vector<MovingHull> nearest(std::span<const MovingHull> all, const Eigen::Vector2d& eye) {
  std::vector<MovingHull> hulls(all.begin(), all.end());
  if (hulls.size() > FoamMap::kMostHulls) {
    const auto end = hulls.begin() + FoamMap::kMostHulls;
    std::nth_element(hulls.begin(), end, hulls.end(), [&](const MovingHull& a, const MovingHull& b) {
      return (a.place - eye).squaredNorm() < (b.place - eye).squaredNorm();
    });
    hulls.erase(end, hulls.end());
  }
  for (MovingHull& hull : hulls) {
    hull.half_length = std::min(hull.half_length, kLongestHull);
    hull.half_beam = std::min(hull.half_beam, kWidestHull);
  }
  return hulls;
}

}  // namespace

double wash_of(double speed) { return 1.0 - std::exp(-std::pow(speed / kWashSpeed, 2)); }

FoamMap::FoamMap() {
  for (std::size_t i = 0; i < kFoamLevels; ++i) {
    levels_[i].texel = kTexels[i];
    levels_[i].texels.resize(static_cast<std::size_t>(kSide) * kSide);
  }
}

void FoamMap::restart(double time, const Eigen::Vector2d& flow) {
  for (FoamLevel& level : levels_) {
    std::fill(level.texels.begin(), level.texels.end(), FoamLevel::Texel());
    mark_all(level);
  }
  trails_.clear();
  drift_ = flow * time;
  reference_ = time;
  shown_ = time;
  last_tick_ = static_cast<std::int64_t>(std::floor(time / kTick));
  started_ = true;
  present_ = false;
}

void FoamMap::move_window(const Eigen::Vector2d& eye) {
  for (FoamLevel& level : levels_) {
    std::array<std::int64_t, 2> first{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double index = (eye - drift_)[static_cast<Eigen::Index>(axis)] / level.texel;
      const auto steps = static_cast<std::int64_t>(std::floor(index / static_cast<double>(kWindowStep)));
      first[axis] = steps * kWindowStep - kSide / 2;
    }
    move_to(level, first);
  }
}

void FoamMap::renew_reference(double time) {
  if (time - reference_ < kRenewal) return;
  const Eigen::Vector2f left = faded(time).cast<float>();
  for (FoamLevel& level : levels_) {
    for (FoamLevel::Texel& texel : level.texels) texel = {left.x() * texel.white, left.y() * texel.churned};
    mark_all(level);
  }
  reference_ = time;
}

void FoamMap::advance(double time, const Eigen::Vector2d& eye, const Eigen::Vector2d& flow,
                      std::span<const MovingHull> all_hulls, const PatchFoam& patch) {
  const std::vector<MovingHull> hulls = nearest(all_hulls, eye);
  if (!started_ || time < shown_ - 1.0 || time > shown_ + kLongestGap) restart(time, flow);
  renew_reference(time);
  move_window(eye);
  for (const MovingHull& hull : hulls)
    if (!trails_.contains(hull.body)) assume_past(trails_[hull.body], hull, time);
  const auto newest = static_cast<std::int64_t>(std::floor(time / kTick));
  const double since = std::max(time - shown_, 0.0);  // s
  const Eigen::Vector2d drifted = drift_ + since * flow;
  for (std::int64_t n = last_tick_ + 1; n <= newest; ++n) {
    const double at = static_cast<double>(n) * kTick;
    drift_ = drifted - std::clamp(time - at, 0.0, since) * flow;
    tick(at, since > 0.0 ? std::clamp(1.0 - (time - at) / since, 0.0, 1.0) : 1.0, hulls);
  }
  drift_ = drifted;
  if (newest > last_tick_) lay_patch(patch, time);
  std::erase_if(trails_, [&](const auto& one) {
    return std::none_of(hulls.begin(), hulls.end(), [&](const MovingHull& hull) { return hull.body == one.first; });
  });
  for (const MovingHull& hull : hulls) trails_[hull.body].hull = hull;
  last_tick_ = std::max(last_tick_, newest);
  shown_ = std::max(shown_, time);
}

void FoamMap::tick(double time, double share, std::span<const MovingHull> hulls) {
  for (const MovingHull& hull : hulls) {
    Trail& trail = trails_[hull.body];
    const bool elsewhere = (hull.place - trail.hull.place).norm() > kFastest * kLongestGap;
    if (elsewhere) trail.points.clear();
    follow(trail, elsewhere ? hull : between(trail.hull, hull, share), time);
  }
}

void FoamMap::follow(Trail& trail, const MovingHull& hull, double time) {
  const Eigen::Vector2d stern = hull.place - 0.94 * hull.half_length * hull.way - drift_;
  const bool leaves = hull.speed >= kLeastSpeed;
  trail.points.push_back({time, stern, leaves ? wash_of(hull.speed) : 0.0, hull.half_beam});
  const double oldest = time - kWidenings.back().age - 2.0 * kTick;
  while (trail.points.size() > 2 && trail.points[1].time < oldest) trail.points.pop_front();
  if (leaves) lay_sides(hull, time);
  lay_wake(trail, time);
}

void FoamMap::lay_sides(const MovingHull& hull, double time) {
  const double wash = wash_of(hull.speed);
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector2d off = side * to_port(hull.way);
    const auto place = [&](double along, double across) {
      return Eigen::Vector2d(hull.place - drift_ + along * hull.half_length * hull.way + across * off);
    };
    Band band{place(0.55, 0.9 * hull.half_beam + 0.6),
              place(-0.9, hull.half_beam + 0.8),
              0.9,
              0.55 * wash,
              0.3 * wash,
              0.0,
              time};
    lay(band);
    // a bow that comes down throws the water aside
    const double slam = std::clamp((hull.slam - 1.2) / 3.5, 0.0, 1.0) * std::clamp(hull.speed / 2.0, 0.3, 1.0);
    if (slam <= 0.0) continue;
    band = {place(0.98, 0.3),
            place(0.6, 0.8 * hull.half_beam + 1.5),
            1.2 + 1.6 * slam,
            0.35 + 0.65 * slam,
            0.5 * slam,
            0.0,
            time};
    lay(band);
  }
}

void FoamMap::lay_wake(const Trail& trail, double time) {
  for (const Widening& widening : kWidenings) {
    // The piece of the trail of that age: between the two points about it.
    const double then = time - widening.age;
    const auto after = std::lower_bound(trail.points.begin(), trail.points.end(), then - 1e-6,
                                        [](const TrailPoint& point, double t) { return point.time < t; });
    if (after == trail.points.end() || after == trail.points.begin()) continue;
    const TrailPoint &from = *std::prev(after), &to = *after;
    const double wash = 0.5 * (from.wash + to.wash);
    if (wash <= 0.01) continue;
    const double spread = kWidenings.front().width / widening.width;
    lay({from.place, to.place, widening.width * to.half_width,
         0.95 * wash * spread * std::exp(-widening.age / kFadeWhite),
         1.15 * wash * std::sqrt(spread) * std::exp(-widening.age / kFadeChurned),
         widening.age < 4.0 ? 0.5 * wash : 0.0, time});
  }
}

void FoamMap::assume_past(Trail& trail, const MovingHull& hull, double time) {
  trail.hull = hull;
  if (hull.speed < kLeastSpeed) return;
  const double wash = wash_of(hull.speed);
  // Speed and path are those through the water, as the lattice is.
  for (int n = static_cast<int>(kAssumedPast / kAssumedStep); n >= 0; --n) {
    const double age = n * kAssumedStep, astern = hull.speed * age;
    const double turn = std::clamp(hull.curvature * astern, -1.5, 1.5);
    MovingHull then = hull;
    then.place += 0.5 * turn * astern * to_port(hull.way) - astern * hull.way;
    then.slam = 0.0;
    lay_sides(then, time - age);
    const Eigen::Vector2d stern = then.place - drift_ - 0.94 * hull.half_length * hull.way;
    trail.points.push_back({time - age, stern, wash, hull.half_beam});
    while (trail.points.size() > 2 && trail.points[1].time < time - age - kWidenings.back().age - 1.0)
      trail.points.pop_front();
    lay_wake(trail, time - age);
  }
}

void FoamMap::lay(const Band& band) {
  for (FoamLevel& level : levels_) lay(level, band);
}

void FoamMap::lay(FoamLevel& level, const Band& band) {
  const double narrow = std::max(1.0, level.texel / band.half_width);  // a texel is the narrowest that shows
  const double width = narrow * band.half_width, reach = 1.35 * width;
  const Eigen::Vector2d low = band.from.cwiseMin(band.to).array() - reach,
                        high = band.from.cwiseMax(band.to).array() + reach;
  const Area area = area_of(level, low, high);
  if (area.empty()) return;
  const Eigen::Vector2d step = band.to - band.from;
  const double length = step.norm(), beyond = std::max(0.5 * length, level.texel);
  const Eigen::Vector2d along = length > 1e-9 ? Eigen::Vector2d(step / length) : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d grown = faded(band.time).cwiseInverse();
  for (std::int64_t y = area.low[1]; y < area.high[1]; ++y) {
    const auto [first, last] = across_row(level, area, band.from, along, reach, y);
    for (std::int64_t x = first; x < last; ++x) {
      const Eigen::Vector2d offset = middle_of(level, x, y) - band.from;
      const double on = offset.dot(along), past = std::max(std::max(-on, on - length), 0.0);
      if (past > beyond) continue;
      const double across = std::abs(offset.dot(to_port(along))) / width, square = across * across;
      if (across > 1.35) continue;
      const double end = 1.0 - past / beyond;  // no step where a band ends, or texels there would flicker
      const double core = end * std::exp(-square * square) / narrow;
      const double rim = end * band.rims * std::exp(-16.0 * (across - 0.95) * (across - 0.95));
      FoamLevel::Texel& texel = level.at(x, y);
      texel.white = std::max(texel.white, static_cast<float>(grown.x() * (band.white * core + rim)));
      texel.churned = std::max(texel.churned, static_cast<float>(grown.y() * band.churned * core));
    }
  }
  mark(level, area);
  present_ = true;
}

void FoamMap::raise(FoamLevel& level, const Eigen::Vector2d& place, double radius, float white) {
  const double reach = std::max(radius, 0.71 * level.texel);
  const Area area = area_of(level, place.array() - reach, place.array() + reach);
  for (std::int64_t y = area.low[1]; y < area.high[1]; ++y)
    for (std::int64_t x = area.low[0]; x < area.high[0]; ++x) {
      const double out = (middle_of(level, x, y) - place).squaredNorm() / (reach * reach);
      if (out >= 1.0) continue;
      float& value = level.at(x, y).white;
      value = std::max(value, white * static_cast<float>(1.0 - out * out));
    }
  if (area.empty()) return;
  mark(level, area);
  present_ = true;
}

void FoamMap::lay_patch(const PatchFoam& patch, double time) {
  const auto grown = static_cast<float>(1.0 / faded(time).x());
  const Eigen::Vector2d middle = patch.origin.head<2>();
  for (std::size_t i = 0; i < patch.particles.size(); ++i) {
    const SurfaceParticle& particle = patch.particles[i];
    const bool falls = i < patch.loose.size() && patch.loose[i] != 0 && particle.velocity.z() < 0.0F;
    const float foam = falls ? 0.8F : static_cast<float>(particle.foam) / 255.0F;
    if (foam < kLeastFoam || particle.phase != 0) continue;
    const Eigen::Vector2d local = particle.position.head<2>().cast<double>();
    if (!local.allFinite()) continue;
    const double share = patch_weight(patch.blend, -patch.half_size, patch.half_size, local);
    const float white = 0.6F * foam * static_cast<float>(share);
    if (white < 0.5F * kLeastFoam) continue;
    for (FoamLevel& level : levels_) raise(level, middle + local - drift_, 0.8 * patch.spacing, grown * white);
  }
}

FoamLevel::Area FoamMap::take_changed(std::size_t level) {
  const Area area = levels_[level].changed;
  levels_[level].changed = {};
  return area;
}

Eigen::Vector2d FoamMap::faded(double time) const {
  return {std::exp(-(time - reference_) / kFadeWhite), std::exp(-(time - reference_) / kFadeChurned)};
}

Eigen::Vector2d FoamMap::at(const Eigen::Vector2d& place, double time) const {
  for (const FoamLevel& level : levels_) {
    const Eigen::Vector2d index = (place - drift_) / level.texel;
    const auto x = static_cast<std::int64_t>(std::floor(index.x())),
               y = static_cast<std::int64_t>(std::floor(index.y()));
    if (x < level.first[0] || y < level.first[1] || x >= level.first[0] + kSide || y >= level.first[1] + kSide)
      continue;
    const FoamLevel::Texel& texel =
        level.texels[static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
    return faded(time).cwiseProduct(Eigen::Vector2d(texel.white, texel.churned));
  }
  return Eigen::Vector2d::Zero();
}

}  // namespace pelagos
