#include "surface_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelagos::validation {

namespace {

constexpr std::size_t kDrop = 3;  ///< fewer particles than this over a gap are a drop
constexpr double kGap = 3.0;      ///< spacings
constexpr std::size_t kEnd = 3;   ///< bins at either wall
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Index of a particle's column; -1 outside the plan.
int column_of(const PlanGrid& grid, const Float4& p) {
  const double cell = 2.0 * grid.spacing;
  const double i = std::floor((static_cast<double>(p.x) - grid.x0) / cell);
  const double j = std::floor((static_cast<double>(p.y) - grid.y0) / cell);
  if (!(i >= 0.0 && i < grid.columns && j >= 0.0 && j < grid.rows)) return -1;
  return static_cast<int>(j) * grid.columns + static_cast<int>(i);
}

std::vector<double> smooth(const std::vector<double>& values) {
  std::vector<double> out(values.size(), kNone);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) out[i] = (values[i - 1] + values[i] + values[i + 1]) / 3.0;
  return out;
}

bool overhangs(std::vector<float>& heights, double spacing) {
  if (heights.size() <= kDrop) return false;
  std::sort(heights.begin(), heights.end());
  for (std::size_t n = 1; n + kDrop <= heights.size(); ++n)
    if (static_cast<double>(heights[n] - heights[n - 1]) > kGap * spacing) return true;
  return false;
}

}  // namespace

PlanGrid plan_grid(double x0, double y0, double length, double width, double spacing) {
  const auto cells = [&](double side) { return static_cast<int>(std::ceil(side / (2.0 * spacing) - 1e-9)); };
  return {x0, y0, spacing, cells(length), cells(width)};
}

SurfaceProfile surface_profile(const PlanGrid& grid, std::span<const Float4> position,
                               std::span<const Float4> velocity) {
  std::vector<std::size_t> highest(static_cast<std::size_t>(grid.columns * grid.rows), position.size());
  for (std::size_t n = 0; n < position.size(); ++n) {
    const int column = column_of(grid, position[n]);
    if (column < 0) continue;
    std::size_t& top = highest[static_cast<std::size_t>(column)];
    if (top == position.size() || position[n].z > position[top].z) top = n;
  }
  SurfaceProfile profile{2.0 * grid.spacing, {}, {}};
  for (int i = 0; i < grid.columns; ++i) {
    double height = 0.0, flow = 0.0;
    int wet = 0;
    for (int j = 0; j < grid.rows; ++j) {
      const std::size_t top = highest[static_cast<std::size_t>(j * grid.columns + i)];
      if (top == position.size()) continue;
      height += static_cast<double>(position[top].z);
      flow += static_cast<double>(velocity[top].x);
      ++wet;
    }
    profile.height.push_back(wet > 0 ? height / wet : kNone);
    profile.flow.push_back(wet > 0 ? flow / wet : kNone);
  }
  return profile;
}

Overhang find_overhang(const PlanGrid& grid, std::span<const Float4> position) {
  std::vector<std::vector<float>> heights(static_cast<std::size_t>(grid.columns * grid.rows));
  for (const Float4& p : position)
    if (const int column = column_of(grid, p); column >= 0) heights[static_cast<std::size_t>(column)].push_back(p.z);
  Overhang found;
  int most = 0;
  for (int j = 0; j < grid.rows; ++j) {
    int here = 0;
    for (int i = 0; i < grid.columns; ++i)
      here += overhangs(heights[static_cast<std::size_t>(j * grid.columns + i)], grid.spacing) ? 1 : 0;
    found.cells += here;
    if (here <= most) continue;
    most = here;
    found.y = grid.y0 + (j + 0.5) * 2.0 * grid.spacing;
  }
  return found;
}

Meeting find_meeting(const SurfaceProfile& profile) {
  const std::vector<double> height = smooth(profile.height), flow = smooth(profile.flow);
  Meeting deepest;
  std::vector<std::size_t> crests;
  for (std::size_t i = kEnd; i + kEnd < height.size(); ++i)
    if (height[i] >= height[i - 1] && height[i] > height[i + 1]) crests.push_back(i);
  for (std::size_t a = 0; a < crests.size(); ++a)
    for (std::size_t b = a + 1; b < crests.size(); ++b) {
      if (!(flow[crests[a]] > 0.0 && flow[crests[b]] < 0.0)) continue;
      double trough = height[crests[a]];
      for (std::size_t i = crests[a]; i < crests[b]; ++i) trough = std::min(trough, height[i]);
      deepest.depth = std::max(deepest.depth, std::min(height[crests[a]], height[crests[b]]) - trough);
    }
  return deepest;
}

}  // namespace pelagos::validation
