#include "booms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace pelagos {

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Segments are longer by this at both ends, so that no way slips through where two of them meet, m.
constexpr double kJoint = 1e-6;

/// The way from `from` to `to` meets the segment; touching its end counts.
bool meets(const Barriers::Segment& s, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double before = (from - s.begin).dot(s.normal), after = (to - s.begin).dot(s.normal);
  if ((before >= 0.0) == (after >= 0.0)) return false;
  const Eigen::Vector2d at = from + (to - from) * (before / (before - after));
  const double along = (at - s.begin).dot(s.along);
  return along >= -kJoint && along <= s.length + kJoint;
}

/// Puts the end of a move on its own side of the segment and `clearance` away from it. @return whether it had to
bool hold_at(const Barriers::Segment& s, const Eigen::Vector2d& from, double clearance, HeldMove& move) {
  const double side = (from - s.begin).dot(s.normal) >= 0.0 ? 1.0 : -1.0;
  const double distance = side * (move.position - s.begin).dot(s.normal);
  const double along = (move.position - s.begin).dot(s.along);
  const bool close = distance >= 0.0 && distance < clearance && along >= 0.0 && along <= s.length;
  if (!close && !meets(s, from, move.position)) return false;
  move.position += side * (clearance - distance) * s.normal;
  move.held = true;
  move.side = side;
  return true;
}

bool overlaps(const Barriers::Box& box, const Eigen::Vector2d& min, const Eigen::Vector2d& max, double margin) {
  return (min.array() <= box.max.array() + margin).all() && (max.array() >= box.min.array() - margin).all();
}

constexpr std::uint32_t kStretch = 16;  ///< segments with a box of their own

Barriers::Line make_line(const std::string& name, const Boom& boom) {
  const auto& points = boom.line;
  Barriers::Line line{name, {points.front(), points.front(), 0, 0}, {}, {}, false};
  line.closed = points.size() > 3 && points.front() == points.back();
  line.segments.reserve(points.size() - 1);
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d way = points[i] - points[i - 1], along = way.normalized();
    line.segments.push_back({points[i - 1], along, {-along.y(), along.x()}, way.norm()});
    if ((i - 1) % kStretch == 0) line.stretches.push_back({points[i - 1], points[i - 1], i - 1, i - 1});
    for (Barriers::Box* box : {&line.box, &line.stretches.back()}) {
      box->min = box->min.cwiseMin(points[i]);
      box->max = box->max.cwiseMax(points[i]);
      box->end = i;
    }
  }
  return line;
}

/// Disjoint sets of elements.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t a = find(i), b = find(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Oil of an element that passes under the boom over dt.
Milligrams leaked_mass(const SlickElement& e, const Boom& boom, double across, double volume, double density_ratio,
                       double dt) {
  const double footprint = std::sqrt(volume / e.film);  // the stretch of boom that this element's film lies at
  double share = boom.entrainment * std::max(across - boom.critical_speed, 0.0) * dt / footprint;
  const double deepest = boom.draft / density_ratio;
  if (e.film > deepest) share = std::max(share, 1.0 - deepest / e.film);
  const double part = std::min(share, 1.0) * static_cast<double>(e.mass);
  return std::min(static_cast<Milligrams>(part), e.mass - 1);
}

/// Leaked oil as an element behind the boom: as thick as where it comes from, a disc's radius away.
SlickElement surface(const Barriers::Segment& s, double side, double oil_density, SlickElement pool) {
  const double radius = std::sqrt(film_volume(pool, oil_density) / (std::numbers::pi * pool.film));
  const double along = std::clamp((pool.position - s.begin).dot(s.along), 0.0, s.length);
  pool.size = radius / kDiscPerSize;
  pool.position = s.begin + along * s.along - side * radius * s.normal;
  pool.contained = false;
  return pool;
}

}  // namespace

void Barriers::set(const std::string& name, const Boom& boom) {
  const auto place = std::lower_bound(lines_.begin(), lines_.end(), name,
                                      [](const Line& line, const std::string& other) { return line.name < other; });
  if (place != lines_.end() && place->name == name)
    *place = make_line(name, boom);
  else
    lines_.insert(place, make_line(name, boom));
}

void Barriers::remove(const std::string& name) {
  std::erase_if(lines_, [&](const Line& line) { return line.name == name; });
}

void Barriers::build(const std::map<std::string, BoomState>& booms) {
  lines_.clear();
  for (const auto& [name, state] : booms) lines_.push_back(make_line(name, state.boom));
}

void Barriers::mark_near(std::span<const SlickElement> elements) {
  near_.assign(elements.size(), 0);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Eigen::Vector2d& at = elements[i].position;
    const double reach = kReachPerSize * elements[i].size;
    for (const Line& line : lines_) {
      if (!overlaps(line.box, at, at, reach)) continue;
      near_[i] = std::any_of(line.stretches.begin(), line.stretches.end(),
                             [&](const Box& stretch) { return overlaps(stretch, at, at, reach); });
      if (near_[i] != 0) break;
    }
  }
}

bool Barriers::crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d min = from.cwiseMin(to), max = from.cwiseMax(to);
  for (const Line& line : lines_) {
    if (!overlaps(line.box, min, max, kJoint)) continue;
    for (const Box& stretch : line.stretches) {
      if (!overlaps(stretch, min, max, kJoint)) continue;
      for (std::uint32_t s = stretch.begin; s < stretch.end; ++s)
        if (meets(line.segments[s], from, to)) return true;
    }
  }
  return false;
}

HeldMove Barriers::hold(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double clearance) const {
  constexpr int kCorners = 4;
  HeldMove move{to};
  const auto may_meet = [&](const Box& box) {
    return overlaps(box, from.cwiseMin(move.position), from.cwiseMax(move.position), clearance + kJoint);
  };
  for (int pass = 0; pass < kCorners; ++pass) {
    bool changed = false;
    for (std::uint32_t n = 0; n < lines_.size(); ++n) {
      if (!may_meet(lines_[n].box)) continue;
      for (const Box& stretch : lines_[n].stretches) {
        if (!may_meet(stretch)) continue;
        for (std::uint32_t k = stretch.begin; k < stretch.end; ++k)
          if (hold_at(lines_[n].segments[k], from, clearance, move)) {
            changed = true;
            move.boom = n;
            move.segment = k;
          }
      }
    }
    if (!changed) return move;
  }
  // A corner too narrow to keep the distance from both sides: stay, unless the last place is on the right side.
  if (crossed(from, move.position)) move.position = from;
  return move;
}

bool Barriers::enclosed(const Eigen::Vector2d& place) const {
  return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
    if (!line.closed || !overlaps(line.box, place, place, 0.0)) return false;
    bool inside = false;
    for (const Box& stretch : line.stretches) {  // those that a ray along x may cross
      if (stretch.max.x() < place.x() || stretch.min.y() > place.y() || stretch.max.y() < place.y()) continue;
      for (std::uint32_t k = stretch.begin; k < stretch.end; ++k) {
        const Segment& s = line.segments[k];
        const Eigen::Vector2d a = s.begin, b = a + s.length * s.along;
        if ((a.y() > place.y()) != (b.y() > place.y()) && (cross(b - a, place - a) > 0.0) == (b.y() > a.y()))
          inside = !inside;
      }
    }
    return inside;
  });
}

void leak_under_booms(const Barriers& barriers, std::span<const BoomContact> contacts, double oil_density,
                      double water_density, double dt, std::vector<SlickElement>& elements,
                      std::map<std::string, BoomState>& booms) {
  if (contacts.empty()) return;
  std::vector<BoomState*> states;
  for (auto& [name, state] : booms) states.push_back(&state);
  Milligrams total = 0;
  for (const SlickElement& e : elements) total += e.mass;
  const Milligrams enough = total / static_cast<Milligrams>(4 * elements.size()) + 1;

  for (const BoomContact& contact : contacts) {
    const Barriers::Segment& s = barriers.lines()[contact.boom].segments[contact.segment];
    BoomState& state = *states[contact.boom];
    SlickElement& e = elements[contact.element];
    const double across = -contact.side * contact.water_velocity.dot(s.normal);
    const Milligrams mass =
        leaked_mass(e, state.boom, across, film_volume(e, oil_density), oil_density / water_density, dt);
    if (mass <= 0) continue;
    const SlickElement piece = split_off(e, mass);
    SlickElement& pool = state.passing[contact.segment];
    if (pool.mass == 0)
      pool = piece;
    else
      pour_in(pool, piece);
    state.passing_side[contact.segment] = contact.side;
  }

  for (std::size_t n = 0; n < states.size(); ++n)
    for (std::size_t k = 0; k < states[n]->passing.size(); ++k)
      if (states[n]->passing[k].mass >= enough)
        elements.push_back(surface(barriers.lines()[n].segments[k], states[n]->passing_side[k], oil_density,
                                   std::exchange(states[n]->passing[k], {})));
}

void mark_contained(const Barriers& barriers, std::span<const BoomContact> contacts,
                    std::span<const ElementPair> touching, std::span<const std::uint8_t> stuck,
                    std::span<SlickElement> elements) {
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i].contained = barriers.enclosed(elements[i].position);
  for (const BoomContact& contact : contacts) elements[contact.element].contained = true;
  Groups groups(elements.size());
  for (const auto& [i, j] : touching)
    if ((stuck[i] || elements[i].contained) && (stuck[j] || elements[j].contained)) groups.join(i, j);
  std::vector<std::uint8_t> held(elements.size(), 0);
  for (std::uint32_t i = 0; i < elements.size(); ++i)
    if (elements[i].contained) held[groups.find(i)] = 1;
  for (std::uint32_t i = 0; i < elements.size(); ++i)
    if (stuck[i] && held[groups.find(i)]) elements[i].contained = true;
}

}  // namespace pelagos
