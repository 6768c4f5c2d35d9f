#include "booms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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

}  // namespace

void Barriers::build(const std::map<std::string, BoomState>& booms) {
  segments_.clear();
  boxes_.clear();
  std::uint32_t number = 0;
  for (const auto& [name, state] : booms) {
    const auto& line = state.boom.line;
    Box box{line.front(), line.front(), static_cast<std::uint32_t>(segments_.size()), 0, false};
    for (std::size_t i = 0; i < line.size(); ++i) {
      box.min = box.min.cwiseMin(line[i]);
      box.max = box.max.cwiseMax(line[i]);
      if (i == 0) continue;
      const Eigen::Vector2d way = line[i] - line[i - 1], along = way.normalized();
      segments_.push_back(
          {line[i - 1], along, {-along.y(), along.x()}, way.norm(), number, static_cast<std::uint32_t>(i - 1)});
    }
    box.end = static_cast<std::uint32_t>(segments_.size());
    box.closed = line.size() > 3 && line.front() == line.back();
    boxes_.push_back(box);
    ++number;
  }
}

void Barriers::mark_near(std::span<const SlickElement> elements) {
  near_.assign(elements.size(), 0);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double reach = kReachPerSize * elements[i].size;
    for (const Box& box : boxes_)
      if (((elements[i].position - box.min).array() >= -reach).all() &&
          ((elements[i].position - box.max).array() <= reach).all())
        near_[i] = 1;
  }
}

bool Barriers::crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d min = from.cwiseMin(to), max = from.cwiseMax(to);
  for (const Box& box : boxes_) {
    if ((min.array() > box.max.array()).any() || (max.array() < box.min.array()).any()) continue;
    for (std::uint32_t s = box.begin; s < box.end; ++s)
      if (meets(segments_[s], from, to)) return true;
  }
  return false;
}

HeldMove Barriers::hold(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double clearance) const {
  constexpr int kCorners = 4;
  HeldMove move{to};
  for (int pass = 0; pass < kCorners; ++pass) {
    bool changed = false;
    for (const Box& box : boxes_) {
      const Eigen::Vector2d min = from.cwiseMin(move.position), max = from.cwiseMax(move.position);
      if ((min.array() > box.max.array() + clearance).any() || (max.array() < box.min.array() - clearance).any())
        continue;
      for (std::uint32_t k = box.begin; k < box.end; ++k) {
        const Segment& s = segments_[k];
        const double side = (from - s.begin).dot(s.normal) >= 0.0 ? 1.0 : -1.0;
        const double distance = side * (move.position - s.begin).dot(s.normal);
        const double along = (move.position - s.begin).dot(s.along);
        const bool close = distance >= 0.0 && distance < clearance && along >= 0.0 && along <= s.length;
        if (!close && !meets(s, from, move.position)) continue;
        move.position += side * (clearance - distance) * s.normal;
        move.held = changed = true;
        move.segment = k;
        move.side = side;
      }
    }
    if (!changed) return move;
  }
  // A corner too narrow to keep the distance from both sides: stay, unless the last place is on the right side.
  if (crossed(from, move.position)) move.position = from;
  return move;
}

bool Barriers::enclosed(const Eigen::Vector2d& place) const {
  for (const Box& box : boxes_) {
    if (!box.closed || (place.array() < box.min.array()).any() || (place.array() > box.max.array()).any()) continue;
    bool inside = false;
    for (std::uint32_t k = box.begin; k < box.end; ++k) {
      const Eigen::Vector2d a = segments_[k].begin, b = a + segments_[k].length * segments_[k].along;
      if ((a.y() > place.y()) != (b.y() > place.y()) && (cross(b - a, place - a) > 0.0) == (b.y() > a.y()))
        inside = !inside;
    }
    if (inside) return true;
  }
  return false;
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
    const Barriers::Segment& s = barriers.segments()[contact.segment];
    BoomState& state = *states[s.boom];
    SlickElement& e = elements[contact.element];
    const double across = -contact.side * contact.water_velocity.dot(s.normal);
    const Milligrams mass =
        leaked_mass(e, state.boom, across, film_volume(e, oil_density), oil_density / water_density, dt);
    if (mass <= 0) continue;
    const SlickElement piece = split_off(e, mass);
    SlickElement& pool = state.passing[s.index];
    if (pool.mass == 0)
      pool = piece;
    else
      pour_in(pool, piece);
    state.passing_side[s.index] = contact.side;
  }

  for (const Barriers::Segment& s : barriers.segments()) {
    SlickElement& pool = states[s.boom]->passing[s.index];
    if (pool.mass < enough) continue;
    // As thick as where it comes from, a disc's radius behind the boom.
    const double radius = std::sqrt(film_volume(pool, oil_density) / (std::numbers::pi * pool.film));
    const double along = std::clamp((pool.position - s.begin).dot(s.along), 0.0, s.length);
    pool.size = radius / kDiscPerSize;
    pool.position = s.begin + along * s.along - states[s.boom]->passing_side[s.index] * radius * s.normal;
    pool.contained = false;
    elements.push_back(pool);
    pool = {};
  }
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
