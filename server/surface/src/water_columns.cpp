#include "surface/water_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "column_sums.hpp"

namespace pelagos {

namespace {

constexpr double kRadius = 2.0;      ///< of a column, spacings; also the width of a bin
constexpr double kLevelDepth = 2.0;  ///< spacings below the topmost particle: where the counted volume begins
constexpr double kSlab = 2.0;        ///< spacings: thickness of the slab that tells how full the column is (ColumnSums)
constexpr double kLeastFilling = 0.25;  ///< of a column: less is not water but spray or a gap
constexpr double kVelocityDepth = 1.5;  ///< spacings

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kMostCellsPerSide = 1024.0F;

/// Farther out than this a coordinate is taken for a numerical fault, NaN included.
constexpr float kFarthest = 1e9F;

bool is_usable(const Float4& p) {
  return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
}

/// Loops over all particles are cut into so many parts, whatever the number of threads.
constexpr std::size_t kChunks = 8;

std::size_t chunk_begin(std::size_t count, std::size_t chunk) { return count * chunk / kChunks; }

std::span<const Float4> chunk_of(std::span<const Float4> position, std::size_t chunk) {
  const std::size_t begin = chunk_begin(position.size(), chunk);
  return position.subspan(begin, chunk_begin(position.size(), chunk + 1) - begin);
}

struct Extent {
  float min_x = kInfinity, min_y = kInfinity, max_x = -kInfinity, max_y = -kInfinity;
  void add(float x, float y) {
    min_x = std::min(min_x, x);
    max_x = std::max(max_x, x);
    min_y = std::min(min_y, y);
    max_y = std::max(max_y, y);
  }
};
using Extents = std::array<Extent, kChunks>;  ///< of the chunks

/// Over all usable particles. Cell corners lie on multiples of the cell, so that the grid does not shift with the
/// outermost particle.
ColumnGrid grid_over(const Extents& extents, float cell) {
  Extent all;
  for (const Extent& extent : extents) {  // one without particles, as of images alone, changes nothing
    all.min_x = std::min(all.min_x, extent.min_x);
    all.max_x = std::max(all.max_x, extent.max_x);
    all.min_y = std::min(all.min_y, extent.min_y);
    all.max_y = std::max(all.max_y, extent.max_y);
  }
  const auto [min_x, min_y, max_x, max_y] = all;
  if (!(std::abs(min_x) < kFarthest)) return {};  // no particles: infinite
  ColumnGrid grid;
  grid.cell = std::max({cell, (max_x - min_x) / kMostCellsPerSide, (max_y - min_y) / kMostCellsPerSide});
  grid.origin_x = grid.cell * std::floor(min_x / grid.cell);
  grid.origin_y = grid.cell * std::floor(min_y / grid.cell);
  grid.columns = static_cast<int>((max_x - grid.origin_x) / grid.cell) + 1;
  grid.rows = static_cast<int>((max_y - grid.origin_y) / grid.cell) + 1;
  return grid;
}

}  // namespace

ColumnGrid make_column_grid(TaskPool& pool, std::span<const Float4> position, float cell) {
  Extents extents;
  pool.for_each_block(kChunks, [&](std::size_t chunk) {
    for (const Float4& p : chunk_of(position, chunk))
      if (is_usable(p)) extents[chunk].add(p.x, p.y);
  });
  return grid_over(extents, cell);
}

ColumnWater ColumnWater::of(const FluidState& fluid) {
  return {fluid.particles.position, fluid.particles.velocity, fluid.particles.count,
          fluid.ghosts.begin,       fluid.ghosts.count,       fluid.parameters.spacing};
}

void WaterColumns::build(TaskPool& pool, const ColumnWater& water) {
  water_ = water;
  const auto cell = static_cast<float>(kRadius * water.spacing);
  if (grid_.columns == 0) use_grid(make_column_grid(pool, water.position.first(water.count), cell));
  if (grid_.columns == 0) return;
  // The water mostly covers the cells that it covered the last time; where it does not, they are found anew.
  const ColumnGrid grid = count_in_bins(pool, cell);
  if (grid != grid_) {
    use_grid(grid);
    if (grid_.columns == 0) return;
    static_cast<void>(count_in_bins(pool, cell));
  }
  sort_into_bins(pool);
}

void WaterColumns::use_grid(const ColumnGrid& grid) {
  grid_ = grid;
  bins_ = {grid.origin_x - grid.cell, grid.origin_y - grid.cell, grid.cell, grid.columns + 2, grid.rows + 2};
}

/// The number of bins where the place is outside of them.
std::size_t WaterColumns::bin_of(double x, double y) const {
  const double gx = (x - static_cast<double>(bins_.origin_x)) / static_cast<double>(bins_.cell);
  const double gy = (y - static_cast<double>(bins_.origin_y)) / static_cast<double>(bins_.cell);
  if (!(gx >= 0.0 && gy >= 0.0 && gx < bins_.columns && gy < bins_.rows)) return bins_.cell_count();
  return bins_.index(static_cast<int>(gx), static_cast<int>(gy));
}

/// The first half of a counting sort whose order is that of one chunk, whatever the chunks.
ColumnGrid WaterColumns::count_in_bins(TaskPool& pool, float cell) {
  const std::size_t count = water_.count + water_.images, none = bins_.cell_count();
  const Float4* const position = water_.position.data();
  const float inverse = 1.0F / bins_.cell;
  const auto columns = static_cast<float>(bins_.columns), rows = static_cast<float>(bins_.rows);
  bin_.resize(count);
  next_.assign((none + 1) * kChunks, 0);  // [chunk][bin]: how many, then where to
  Extents extents;
  pool.for_each_block(kChunks, [&](std::size_t chunk) {
    std::uint32_t* const counts = next_.data() + chunk * (none + 1);
    Extent extent;
    for (std::size_t n = chunk_begin(count, chunk); n < chunk_begin(count, chunk + 1); ++n) {
      const Float4& p = position[index_of(n)];
      if (n < water_.count && is_usable(p)) extent.add(p.x, p.y);
      const float gx = (p.x - bins_.origin_x) * inverse, gy = (p.y - bins_.origin_y) * inverse;
      const bool inside = gx >= 0.0F && gy >= 0.0F && gx < columns && gy < rows && std::abs(p.z) < kFarthest;
      bin_[n] = static_cast<std::uint32_t>(inside ? bins_.index(static_cast<int>(gx), static_cast<int>(gy)) : none);
      ++counts[bin_[n]];
    }
    extents[chunk] = extent;
  });
  return grid_over(extents, cell);
}

void WaterColumns::sort_into_bins(TaskPool& pool) {
  const std::size_t count = bin_.size(), none = bins_.cell_count();
  const Float4* const position = water_.position.data();
  begin_.resize(none + 1);
  std::uint32_t place = 0;
  for (std::size_t k = 0; k < none; ++k) {
    begin_[k] = place;
    for (std::size_t chunk = 0; chunk < kChunks; ++chunk) place += std::exchange(next_[chunk * (none + 1) + k], place);
  }
  begin_[none] = place;
  for (auto* values : {&x_, &y_, &z_}) values->resize(place);
  particle_.resize(place);
  pool.for_each_block(kChunks, [&](std::size_t chunk) {
    std::uint32_t* const to = next_.data() + chunk * (none + 1);
    for (std::size_t n = chunk_begin(count, chunk); n < chunk_begin(count, chunk + 1); ++n) {
      if (bin_[n] == none) continue;
      const std::size_t index = index_of(n), k = to[bin_[n]]++;
      const Float4& p = position[index];
      x_[k] = p.x;
      y_[k] = p.y;
      z_[k] = p.z;
      particle_[k] = static_cast<std::uint32_t>(index);
    }
  });
}

WaterColumns::Ranges WaterColumns::ranges_about(std::size_t bin) const {
  const int i = static_cast<int>(bin) % bins_.columns, j = static_cast<int>(bin) / bins_.columns;
  const int first = std::max(i - 1, 0), last = std::min(i + 1, bins_.columns - 1);
  Ranges ranges{};
  for (int row = 0; row < 3; ++row) {
    const int b = j + row - 1;
    if (b < 0 || b >= bins_.rows) continue;
    ranges[static_cast<std::size_t>(row)] = {begin_[bins_.index(first, b)], begin_[bins_.index(last, b) + 1]};
  }
  return ranges;
}

Eigen::Vector3d WaterColumns::mean_velocity(const Ranges& ranges, const Eigen::Vector2d& at, double surface) const {
  const double bottom = surface - kVelocityDepth * water_.spacing, top = surface + 2.0 * water_.spacing;
  const double inverse = 1.0 / (kRadius * kRadius * water_.spacing * water_.spacing);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const auto& [begin, end] : ranges)
    for (std::uint32_t n = begin; n < end; ++n) {
      const auto z = static_cast<double>(z_[n]);
      if (z < bottom || z > top) continue;
      const Eigen::Vector2d way(static_cast<double>(x_[n]) - at.x(), static_cast<double>(y_[n]) - at.y());
      const double rest = 1.0 - way.squaredNorm() * inverse;
      if (!(rest > 0.0)) continue;
      const Float4& v = water_.velocity[particle_[n]];
      sum += rest * rest * Eigen::Vector3d(v.x, v.y, v.z);
      total += rest * rest;
    }
  return total > 0.0 ? Eigen::Vector3d(sum / total) : sum;
}

/// Weighed by how near the particles are to the place.
Eigen::Vector3d WaterColumns::velocity_near(const Ranges& ranges, const Eigen::Vector3d& at) const {
  const double inverse = 1.0 / (kRadius * kRadius * water_.spacing * water_.spacing);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const auto& [begin, end] : ranges)
    for (std::uint32_t n = begin; n < end; ++n) {
      const Eigen::Vector3d place(static_cast<double>(x_[n]), static_cast<double>(y_[n]), static_cast<double>(z_[n]));
      const double rest = 1.0 - (place - at).squaredNorm() * inverse;
      if (!(rest > 0.0)) continue;
      const Float4& v = water_.velocity[particle_[n]];
      sum += rest * rest * Eigen::Vector3d(v.x, v.y, v.z);
      total += rest * rest;
    }
  return total > 0.0 ? Eigen::Vector3d(sum / total) : sum;
}

SurfaceReading WaterColumns::read_in(const Ranges& ranges, const Eigen::Vector2d& at) const {
  const double d = water_.spacing, radius = kRadius * d;
  ColumnRows rows;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto [begin, end] = ranges[row];
    rows[row] = {x_.data() + begin, y_.data() + begin, z_.data() + begin, end - begin};
  }
  const ColumnAxis axis{static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(radius),
                        static_cast<float>(d)};
  // m that a particle of weight 1 fills of the column
  const double scale = 3.0 / (std::numbers::pi * radius * radius) * d * d * d;
  float top = kInfinity;
  ColumnSums sums;
  do {  // a lone drop is no top
    top = highest_below(rows, axis, top);
    if (top == -kInfinity) return {};
    sums = sum_column(rows, axis, top);
  } while (!(scale * static_cast<double>(sums.under_top) > kLeastFilling * kLevelDepth * d));

  const double level = static_cast<double>(top) - kLevelDepth * d, counted = scale * static_cast<double>(sums.counted);
  double filling = scale * static_cast<double>(sums.slab) / (kSlab * d);
  Eigen::Vector2d drift = scale / (kSlab * d) * Eigen::Vector2f(sums.slab_way_x, sums.slab_way_y).cast<double>();
  if (!sums.deep || filling < kLeastFilling) {
    filling = std::clamp(counted / (kLevelDepth * d), kLeastFilling, 1.0);
    drift.setZero();
  }
  SurfaceReading reading;
  reading.wet = true;
  const double water = counted / filling;
  reading.height = level + water;
  // Second moment of the column's weight along an axis: R^2 / 8.
  const Eigen::Vector2d moment = scale * Eigen::Vector2f(sums.counted_way_x, sums.counted_way_y).cast<double>();
  const Eigen::Vector2d slope = (moment - water * drift) / (filling * radius * radius / 8.0);
  reading.normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  return reading;
}

SurfaceReading WaterColumns::read(const SurfacePlace& place) const {
  if (grid_.columns == 0 || !place.local.allFinite()) return {};
  const std::size_t bin = bin_of(place.local.x(), place.local.y());
  if (bin == bins_.cell_count()) return {};
  const Ranges ranges = ranges_about(bin);
  SurfaceReading reading = read_in(ranges, place.local);
  if (!reading.wet) return reading;
  reading.velocity = place.height && *place.height < reading.height
                         ? velocity_near(ranges, {place.local.x(), place.local.y(), *place.height})
                         : mean_velocity(ranges, place.local, reading.height);
  return reading;
}

namespace {

/// Calls body(i, j, centre) for each cell of a grid, rows in parallel.
template <class F>
void for_each_cell(TaskPool& pool, const ColumnGrid& grid, F&& body) {
  const double cell = static_cast<double>(grid.cell);
  pool.for_each_range(static_cast<std::size_t>(grid.rows), 2, [&](std::size_t begin, std::size_t end) {
    for (auto j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
      for (int i = 0; i < grid.columns; ++i)
        body(i, j,
             Eigen::Vector2d(static_cast<double>(grid.origin_x) + (i + 0.5) * cell,
                             static_cast<double>(grid.origin_y) + (j + 0.5) * cell));
  });
}

}  // namespace

void WaterColumns::sample(TaskPool& pool, SurfaceGrid& surface) const {
  surface.grid = grid_;
  surface.cells.assign(grid_.cell_count(), {});
  for_each_cell(pool, grid_, [&](int i, int j, const Eigen::Vector2d& centre) {
    const SurfaceReading reading = read_in(ranges_about(bins_.index(i + 1, j + 1)), centre);
    SurfaceCell& cell = surface.cells[grid_.index(i, j)];
    cell.height = static_cast<float>(reading.height);
    cell.wet = reading.wet;
  });
}

void WaterColumns::add_velocities(TaskPool& pool, SurfaceGrid& surface) const {
  for_each_cell(pool, grid_, [&](int i, int j, const Eigen::Vector2d& centre) {
    SurfaceCell& cell = surface.cells[grid_.index(i, j)];
    if (!cell.wet) return;
    const Ranges ranges = ranges_about(bins_.index(i + 1, j + 1));
    cell.velocity = mean_velocity(ranges, centre, static_cast<double>(cell.height)).cast<float>();
  });
}

}  // namespace pelagos
