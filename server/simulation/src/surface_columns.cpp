#include "simulation/surface_columns.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace pelagos {

namespace {

constexpr double kRadius = 2.0;         ///< of a column, spacings
constexpr double kLevelDepth = 2.0;     ///< spacings below the topmost particle: where the counted volume begins
constexpr double kSlab = 2.0;           ///< spacings: thickness of the slab that tells how full the column is
constexpr double kLeastFilling = 0.25;  ///< of a column: less is not water but spray or a gap
constexpr double kVelocityDepth = 1.5;  ///< spacings

/// A particle of a column: relative to the column's axis.
struct Member {
  Eigen::Vector2d way;  ///< m
  double z = 0.0;       ///< m, local
  double weight = 0.0;  ///< share of the column's cross-section, 1/m^2 times V: m of height that it fills
  std::uint32_t particle = 0;
};
using Column = std::vector<Member>;

/// Finds the columns that a point may be part of: cells as wide as a column over the box around those places that water
/// may be near. A body may stand a hundred kilometres off: places outside the tank and its images get no cells.
class PlaceGrid {
 public:
  PlaceGrid(const Region& tank, std::span<const SurfacePlace> places, double radius) : inverse_(1.0 / radius) {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(2.0 * radius);
    const Eigen::AlignedBox2d near_water(Eigen::Vector2f(tank.min[0], tank.min[1]).cast<double>() - margin,
                                         Eigen::Vector2f(tank.max[0], tank.max[1]).cast<double>() + margin);
    Eigen::AlignedBox2d box;
    for (const SurfacePlace& place : places)
      if (near_water.contains(place.local)) box.extend(place.local);
    if (box.isEmpty()) return;
    corner_ = box.min() - Eigen::Vector2d::Constant(1.5 * radius);
    columns_ = static_cast<int>(box.sizes().x() * inverse_) + 4;
    rows_ = static_cast<int>(box.sizes().y() * inverse_) + 4;
    list_of_cell_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      if (!near_water.contains(places[k].local)) continue;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) add(k, cell(places[k].local, i, j));
    }
  }
  /// Those whose cell or a neighbour of it holds the point; null if none.
  [[nodiscard]] const std::vector<std::uint32_t>* near(const Eigen::Vector2d& at) const {
    const std::size_t k = cell(at, 0, 0);
    return k >= list_of_cell_.size() || list_of_cell_[k] < 0 ? nullptr
                                                             : &lists_[static_cast<std::size_t>(list_of_cell_[k])];
  }

 private:
  [[nodiscard]] std::size_t cell(const Eigen::Vector2d& at, int i, int j) const {
    const Eigen::Vector2d g = (at - corner_) * inverse_;
    if (!(g.x() >= 0.0 && g.y() >= 0.0 && g.x() < columns_ && g.y() < rows_)) return list_of_cell_.size();
    return static_cast<std::size_t>((static_cast<int>(g.y()) + j) * columns_ + static_cast<int>(g.x()) + i);
  }
  void add(std::uint32_t place, std::size_t cell) {
    if (list_of_cell_[cell] < 0) {
      list_of_cell_[cell] = static_cast<std::int32_t>(lists_.size());
      lists_.emplace_back();
    }
    lists_[static_cast<std::size_t>(list_of_cell_[cell])].push_back(place);
  }

  double inverse_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  int columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> list_of_cell_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

void collect(const FluidState& fluid, std::size_t begin, std::size_t end, std::span<const SurfacePlace> places,
             const PlaceGrid& grid, std::vector<Column>& columns) {
  const double radius = kRadius * fluid.parameters.spacing;
  const double scale = 3.0 / (std::numbers::pi * radius * radius) * fluid.parameters.volume();
  for (std::size_t i = begin; i < end; ++i) {
    const Float4& p = fluid.particles.position[i];
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    const Eigen::Vector2d at(p.x, p.y);
    const std::vector<std::uint32_t>* near = grid.near(at);
    if (!near) continue;
    for (const std::uint32_t k : *near) {
      const Eigen::Vector2d way = at - places[k].local;
      const double rest = 1.0 - way.squaredNorm() / (radius * radius);
      if (rest > 0.0)
        columns[k].push_back({way, static_cast<double>(p.z), scale * rest * rest, static_cast<std::uint32_t>(i)});
    }
  }
}

/// How much of a particle of thickness d is above a level.
double share_above(double z, double level, double spacing) { return std::clamp((z - level) / spacing + 0.5, 0.0, 1.0); }

/// What a column holds between two levels: height filled (m) and its first moments (m^2).
struct Content {
  double height = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
};
Content content(const Column& column, double bottom, double top, double spacing) {
  Content sum;
  for (const Member& member : column) {
    const double share = member.weight * (share_above(member.z, bottom, spacing) - share_above(member.z, top, spacing));
    sum.height += share;
    sum.moment += share * member.way;
  }
  return sum;
}

/// The topmost particle that has water below it; nothing where all is spray. `column` is sorted, highest first.
const Member* find_top(const Column& column, double spacing) {
  for (const Member& candidate : column) {
    double filled = 0.0;
    for (const Member& member : column)
      if (member.z <= candidate.z && member.z > candidate.z - 2.0 * spacing) filled += member.weight;
    if (filled > kLeastFilling * 2.0 * spacing) return &candidate;
  }
  return nullptr;
}

Eigen::Vector3d mean_velocity(const FluidState& fluid, const Column& column, double bottom, double top) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const Member& member : column) {
    if (member.z < bottom || member.z > top) continue;
    const Float4& v = fluid.particles.velocity[member.particle];
    sum += member.weight * Eigen::Vector3d(v.x, v.y, v.z);
    weight += member.weight;
  }
  return weight > 0.0 ? Eigen::Vector3d(sum / weight) : sum;
}

/// Weighed by how near the particles are to the column's axis and to the height.
Eigen::Vector3d velocity_near(const FluidState& fluid, const Column& column, double height) {
  const double radius = kRadius * fluid.parameters.spacing;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const Member& member : column) {
    const double rest =
        1.0 - (member.way.squaredNorm() + (member.z - height) * (member.z - height)) / (radius * radius);
    if (!(rest > 0.0)) continue;
    const Float4& v = fluid.particles.velocity[member.particle];
    sum += rest * rest * Eigen::Vector3d(v.x, v.y, v.z);
    weight += rest * rest;
  }
  return weight > 0.0 ? Eigen::Vector3d(sum / weight) : sum;
}

SurfaceReading read_column(const FluidState& fluid, const SurfacePlace& place, Column& column) {
  SurfaceReading reading;
  const double d = fluid.parameters.spacing, radius = kRadius * d;
  std::sort(column.begin(), column.end(),
            [](const Member& a, const Member& b) { return a.z != b.z ? a.z > b.z : a.particle < b.particle; });
  const Member* top = find_top(column, d);
  if (!top) return reading;
  reading.wet = true;
  const double level = top->z - kLevelDepth * d, above = top->z + 2.0 * d;
  const Content counted = content(column, level, above, d), slab = content(column, level - kSlab * d, level, d);
  double filling = slab.height / (kSlab * d);
  Eigen::Vector2d drift = slab.moment / (kSlab * d);
  if (column.back().z > level - (kSlab - 0.5) * d || filling < kLeastFilling) {  // shallow: no such slab
    filling = std::clamp(counted.height / (kLevelDepth * d), kLeastFilling, 1.0);
    drift.setZero();
  }
  const double water = counted.height / filling;
  reading.height = level + water;
  // Second moment of the column's weight along an axis: R^2 / 8.
  const Eigen::Vector2d slope = (counted.moment - water * drift) / (filling * radius * radius / 8.0);
  reading.normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  reading.velocity = place.height && *place.height < reading.height
                         ? velocity_near(fluid, column, *place.height)
                         : mean_velocity(fluid, column, reading.height - kVelocityDepth * d, above);
  return reading;
}

}  // namespace

std::vector<SurfaceReading> read_surface(const FluidState& fluid, std::span<const SurfacePlace> places) {
  std::vector<SurfaceReading> readings(places.size());
  if (places.empty()) return readings;
  const PlaceGrid grid(fluid.parameters.tank, places, kRadius * fluid.parameters.spacing);
  std::vector<Column> columns(places.size());
  collect(fluid, 0, fluid.particles.count, places, grid, columns);
  if (!fluid.ghosts.empty())
    collect(fluid, fluid.ghosts.begin, fluid.ghosts.begin + fluid.ghosts.count, places, grid, columns);
  for (std::size_t k = 0; k < places.size(); ++k) readings[k] = read_column(fluid, places[k], columns[k]);
  return readings;
}

}  // namespace pelagos
