#include "wind/column_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pelagos {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kMostCellsPerSide = 1024.0f;

/// Farther out than this a coordinate is taken for a numerical fault, NaN included.
constexpr float kFarthest = 1e9f;

bool is_usable(const Float4& p) {
  return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
}

}  // namespace

ColumnGrid make_column_grid(std::span<const Float4> position, float cell) {
  float min_x = kInfinity, min_y = kInfinity, max_x = -kInfinity, max_y = -kInfinity;
  for (const Float4& p : position) {
    if (!is_usable(p)) continue;
    min_x = std::min(min_x, p.x);
    max_x = std::max(max_x, p.x);
    min_y = std::min(min_y, p.y);
    max_y = std::max(max_y, p.y);
  }
  if (!(min_x <= max_x)) return {};
  ColumnGrid grid;
  grid.cell = std::max({cell, (max_x - min_x) / kMostCellsPerSide, (max_y - min_y) / kMostCellsPerSide});
  // Cell corners lie on multiples of the cell, so that the grid does not shift with the outermost particle.
  grid.origin_x = grid.cell * std::floor(min_x / grid.cell);
  grid.origin_y = grid.cell * std::floor(min_y / grid.cell);
  grid.columns = static_cast<int>((max_x - grid.origin_x) / grid.cell) + 1;
  grid.rows = static_cast<int>((max_y - grid.origin_y) / grid.cell) + 1;
  return grid;
}

void find_highest(const ColumnGrid& grid, std::span<const Float4> position, std::vector<float>& height) {
  height.assign(grid.cell_count(), -kInfinity);
  const float inverse = 1.0f / grid.cell;
  for (const Float4& p : position) {
    if (!is_usable(p)) continue;
    const int i = std::clamp(static_cast<int>((p.x - grid.origin_x) * inverse), 0, grid.columns - 1);
    const int j = std::clamp(static_cast<int>((p.y - grid.origin_y) * inverse), 0, grid.rows - 1);
    float& highest = height[grid.index(i, j)];
    highest = std::max(highest, p.z);
  }
}

float surface_height(const ColumnGrid& grid, std::span<const float> height, int i, int j, float allowance,
                     float fallback) {
  std::array<float, 9> around{};
  std::size_t found = 0;
  for (int b = std::max(j - 1, 0); b <= std::min(j + 1, grid.rows - 1); ++b)
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, grid.columns - 1); ++a)
      if (const float z = height[grid.index(a, b)]; z > -kInfinity) around[found++] = z;
  if (found == 0) return fallback;
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>((found - 1) / 2);
  std::nth_element(around.begin(), middle, around.begin() + static_cast<std::ptrdiff_t>(found));
  const float own = height[grid.index(i, j)];
  return own > -kInfinity ? std::min(own, *middle + allowance) : *middle;
}

}  // namespace pelagos
