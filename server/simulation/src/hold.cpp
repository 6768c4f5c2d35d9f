#include "simulation/hold.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace pelagos {

namespace {

constexpr double kCell = 0.5;          ///< spacings
constexpr double kMostCells = 150000;  ///< about: larger bodies have larger cells
constexpr double kLeastDepth = 1.0;    ///< spacings: shallower hollows are no holds
constexpr double kNearby = 1.01;       ///< cells: a way between neighbours farther from the surface is clear

constexpr std::array<std::array<int, 3>, 6> kSteps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

std::array<int, 3> step(const std::array<int, 3>& cell, const std::array<int, 3>& by) {
  return {cell[0] + by[0], cell[1] + by[1], cell[2] + by[2]};
}

}  // namespace

Hold::Hold(const BodyShape& shape, double spacing) : surface_(shape.surface) {
  if (shape.kind != MeshKind::kClosed || !surface_) return;
  lay_cells(shape, spacing);
  mark_hollows(spill_heights(), kLeastDepth * spacing);
  collect_rooms();
  depth_ = {};
  if (rooms_.empty()) cells_ = {};
}

std::array<int, 3> Hold::cell_of(std::size_t index) const {
  const auto x = static_cast<std::size_t>(count_[0]), y = static_cast<std::size_t>(count_[1]);
  return {static_cast<int>(index % x), static_cast<int>(index / x % y), static_cast<int>(index / (x * y))};
}

bool Hold::is_within(const std::array<int, 3>& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (cell[axis] < 0 || cell[axis] >= count_[axis]) return false;
  return true;
}

bool Hold::is_border(const std::array<int, 3>& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (cell[axis] == 0 || cell[axis] == count_[axis] - 1) return true;
  return false;
}

bool Hold::is_clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const double length = (to - from).norm();
  return length == 0.0 || surface_->first_hit(from, (to - from) / length, 0.0) > length;
}

template <class Visit>
void Hold::for_each_way(const std::array<int, 3>& cell, Visit&& visit) const {
  const std::size_t here = index(cell);
  for (const auto& by : kSteps) {
    const std::array<int, 3> next = step(cell, by);
    if (!is_within(next)) continue;
    const std::size_t there = index(next);
    if (!(cells_[there] & kFree)) continue;
    const bool near = (cells_[here] & kNear) && (cells_[there] & kNear);
    if (!near || is_clear(centre_of(cell), centre_of(next))) visit(there, next);
  }
}

/// One ring of cells more than the box around the body, all of it outside.
void Hold::lay_cells(const BodyShape& shape, double spacing) {
  const Eigen::AlignedBox3d& box = shape.bounding_box;
  size_ = std::max(kCell * spacing, std::cbrt(box.volume() / kMostCells));
  for (int axis = 0; axis < 3; ++axis)
    count_[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(box.sizes()[axis] / size_ - 1e-6)) + 2;
  first_ = box.min() - Eigen::Vector3d::Constant(0.5 * size_);
  cells_.assign(
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]),
      0);
  depth_.assign(cells_.size(), 0.0F);
  const double nearby = kNearby * size_;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const Eigen::Vector3d x = centre_of(cell_of(k));
    const double distance = surface_->distance(x, nearby);
    const bool solid = surface_->inside(x);
    cells_[k] = static_cast<std::uint8_t>((solid ? 0 : kFree) | (distance < nearby ? kNear : 0));
    depth_[k] = static_cast<float>(solid ? -distance : distance);
  }
}

/// For each cell the height that water outside must rise above to reach it, m; infinity where it never does.
std::vector<float> Hold::spill_heights() const {
  std::vector<float> spill(cells_.size(), std::numeric_limits<float>::infinity());
  using Front = std::pair<float, std::size_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  const auto height = [&](const std::array<int, 3>& cell) { return static_cast<float>(centre_of(cell).z()); };
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const auto cell = cell_of(k);
    if (is_border(cell)) fronts.push({spill[k] = height(cell), k});
  }
  while (!fronts.empty()) {
    const auto [level, k] = fronts.top();
    fronts.pop();
    if (level > spill[k]) continue;
    for_each_way(cell_of(k), [&](std::size_t next, const std::array<int, 3>& cell) {
      const float reached = std::max(level, height(cell));
      if (reached < spill[next]) fronts.push({spill[next] = reached, next});
    });
  }
  return spill;
}

void Hold::mark_hollows(const std::vector<float>& spill, double least_depth) {
  const auto depth = [&](std::size_t k) { return static_cast<double>(spill[k]) - centre_of(cell_of(k)).z(); };
  const auto is_low = [&](std::size_t k) { return (cells_[k] & kFree) && depth(k) > 0.5 * size_; };
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (!is_low(k) || (cells_[k] & kReached)) continue;
    std::vector<std::size_t> hollow{k};
    cells_[k] |= kReached;
    double deepest = 0.0;
    for (std::size_t n = 0; n < hollow.size(); ++n) {
      deepest = std::max(deepest, depth(hollow[n]));
      for_each_way(cell_of(hollow[n]), [&](std::size_t next, const std::array<int, 3>&) {
        if (!is_low(next) || (cells_[next] & kReached)) return;
        cells_[next] |= kReached;
        hollow.push_back(next);
      });
    }
    if (deepest < least_depth) continue;
    for (const std::size_t n : hollow) cells_[n] |= kHold;
  }
}

/// How much of a cell is free follows from the depth of its centre: exact for a flat plate along the cells.
void Hold::collect_rooms() {
  const double whole = size_ * size_ * size_;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const auto cell = cell_of(k);
    bool in_hold = cells_[k] & kHold;
    if (!(cells_[k] & kFree))
      for (const auto& by : kSteps)
        if (const auto next = step(cell, by); is_within(next) && (cells_[index(next)] & kHold)) in_hold = true;
    const double share = std::clamp(0.5 + static_cast<double>(depth_[k]) / size_, 0.0, 1.0);
    if (!in_hold || share <= 0.0) continue;
    rooms_.push_back({centre_of(cell).cast<float>(), static_cast<float>(share * whole)});
    volume_ += share * whole;
  }
}

PartVolume Hold::below(const WaterPlane& water) const {
  PartVolume part;
  const double thickness = size_ * water.up.lpNorm<1>();
  for (const Room& room : rooms_) {
    const Eigen::Vector3d centre = room.centre.cast<double>();
    const double wet = std::clamp(0.5 + (water.level - water.up.dot(centre)) / thickness, 0.0, 1.0);
    part.volume += wet * static_cast<double>(room.volume);
    part.moment += wet * static_cast<double>(room.volume) * centre;
  }
  return part;
}

bool Hold::is_in(const Eigen::Vector3d& point, std::uint8_t flag) const {
  if (rooms_.empty()) return false;
  std::array<int, 3> cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double place = (point[axis] - first_[axis]) / size_ + 0.5;
    if (!(place >= 0.0 && place < count_[static_cast<std::size_t>(axis)])) return false;
    cell[static_cast<std::size_t>(axis)] = static_cast<int>(place);
  }
  const std::uint8_t flags = cells_[index(cell)];
  if (!(flags & kNear)) return flags & flag;
  if ((flags & kFree) && is_clear(point, centre_of(cell))) return flags & flag;
  for (const auto& by : kSteps)
    if (const auto next = step(cell, by);
        is_within(next) && (cells_[index(next)] & kFree) && is_clear(point, centre_of(next)))
      return cells_[index(next)] & flag;
  return false;
}

void Hold::dry_out(const std::function<bool(const Eigen::Vector3d&)>& is_water,
                   const std::function<bool(const Eigen::Vector3d&)>& is_poured) {
  std::vector<std::size_t> reached;
  const auto reach = [&](std::size_t k) {
    if (cells_[k] & kReached) return;
    cells_[k] |= kReached;
    reached.push_back(k);
  };
  for (std::uint8_t& flags : cells_) flags = static_cast<std::uint8_t>(flags & ~kReached);
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (!(cells_[k] & kFree)) continue;
    const auto cell = cell_of(k);
    if ((is_border(cell) && is_water(centre_of(cell))) || is_poured(centre_of(cell))) reach(k);
  }
  for (std::size_t n = 0; n < reached.size(); ++n)
    for_each_way(cell_of(reached[n]), [&](std::size_t next, const std::array<int, 3>& cell) {
      if (is_water(centre_of(cell))) reach(next);
    });
  for (std::uint8_t& flags : cells_)
    if ((flags & kHold) && !(flags & kReached)) flags |= kDry, any_dry_ = true;
}

}  // namespace pelagos
