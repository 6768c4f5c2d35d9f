#include <algorithm>
#include <cmath>

#include "wind/drag.hpp"
#include "wind/wind.hpp"

namespace pelagos {

// The depth profile f of the law gust.
//
// The paper's wind adds to a particle at height z above the bottom, every step (eq. 33, 34),
//   dv = beta (rho_air / rho) v_ref ln(z / z0) / ln(h_ref / z0) ,   z0 = 0.01 m, h_ref = 10 m.
// Its wind scene (section VI.B with L = 1 m, d = 0.05 m, water 0.5 m deep) has nine layers of particles, z = d .. 9 d,
// so the push averaged over a column is, per step and in units of beta (rho_air / rho) v_ref,
//   m = 1/9 sum_{i=1..9} ln(i d / z0) / ln(h_ref / z0) = 0.43891 .
// Taking the step as t_ref = 0.07 sqrt(d / g), the largest the scene may use, turns dv / dt into an acceleration.
// Ours is to fall from 1 at the surface. The simplest law that does is f = exp(-depth / D). With the surface half a
// spacing above the top layer the depths are (i + 1/2) d, and the same mean push asks for
//   1/9 sum_{i=0..8} exp(-(i + 1/2) d / D) = m   ->   D = 4.6139 d .
// D is tied to the spacing and not to the water's depth: the law is scale-free like everything else, a deep column
// takes the same push through its surface as this one (17 % more than its nine layers), and the wind does not act
// like tilted gravity.

namespace {

constexpr float kNegligibleDecays = 7.0f;  ///< deeper than so many decay depths f is below 1e-3 and left out
constexpr std::size_t kParticlesPerBlock = 2048;

/// Push of the air at the surface: a = factor(|v10|) v10 exp(-depth / decay).
struct SurfaceLaw {
  WindLaw law;
  double factor = 0.0;  ///< without what depends on the speed
  double decay = 0.0;   ///< m

  [[nodiscard]] Eigen::Vector3f push(const Eigen::Vector3d& air) const {
    const double speed = air.norm();
    const double drag = law == WindLaw::kStress ? sea_drag_coefficient(speed) * speed : 1.0;
    return (factor * drag * air).cast<float>();
  }
};

SurfaceLaw surface_law(const WindSurroundings& around, const WindSettings& wind) {
  const double density_ratio = Air::kDensity / around.rest_density;
  if (wind.law == WindLaw::kStress) {
    // The layers at (i + 1/2) d share the stress: the sum of d exp(-(i + 1/2)) over all of them is d / (2 sinh(1/2)).
    return {wind.law, density_ratio * 2.0 * std::sinh(0.5) / around.spacing, around.spacing};
  }
  const double reference_time = usual_step(around.spacing, around.gravity);  // infinite without gravity
  return {wind.law, wind.beta * density_ratio / reference_time, Wind::kDecaySpacings * around.spacing};
}

/// Of a dry cell the mean of the wet ones around it, the mean level where there are none.
float height_of(const SurfaceGrid& surface, int i, int j, float level) {
  const ColumnGrid& grid = surface.grid;
  if (const SurfaceCell& own = surface.cells[grid.index(i, j)]; own.wet) return own.height;
  float sum = 0.0f;
  int found = 0;
  for (int b = std::max(j - 1, 0); b <= std::min(j + 1, grid.rows - 1); ++b)
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, grid.columns - 1); ++a)
      if (const SurfaceCell& cell = surface.cells[grid.index(a, b)]; cell.wet) sum += cell.height, ++found;
  return found > 0 ? sum / static_cast<float>(found) : level;
}

/// The push at the surface and the surface's height, column by column.
void fill_columns(TaskPool& pool, const SurfaceGrid& surface, const Air& air, const Air::Moment& moment,
                  const SurfaceLaw& law, std::vector<Float4>& columns) {
  const ColumnGrid& grid = surface.grid;
  const double level = air.local_level();
  columns.resize(grid.cell_count());
  pool.for_each_range(static_cast<std::size_t>(grid.rows), 4, [&](std::size_t begin, std::size_t end) {
    for (int j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
      for (int i = 0; i < grid.columns; ++i) {
        const Eigen::Vector3d centre(static_cast<double>(grid.origin_x) + (i + 0.5) * static_cast<double>(grid.cell),
                                     static_cast<double>(grid.origin_y) + (j + 0.5) * static_cast<double>(grid.cell),
                                     level);
        const Eigen::Vector3f push = law.push(air.reference(moment, centre));
        columns[grid.index(i, j)] = {push.x(), push.y(), push.z(), height_of(surface, i, j, static_cast<float>(level))};
      }
  });
}

/// Linear between the four columns around a place; beyond the outermost centres the nearest values hold.
Float4 interpolate(const ColumnGrid& grid, const std::vector<Float4>& columns, float gx, float gy) {
  const float cx = std::clamp(gx, 0.0f, static_cast<float>(grid.columns - 1));
  const float cy = std::clamp(gy, 0.0f, static_cast<float>(grid.rows - 1));
  const int i = std::min(static_cast<int>(cx), std::max(grid.columns - 2, 0));
  const int j = std::min(static_cast<int>(cy), std::max(grid.rows - 2, 0));
  const float u = cx - static_cast<float>(i), v = cy - static_cast<float>(j);
  const int right = std::min(i + 1, grid.columns - 1), upper = std::min(j + 1, grid.rows - 1);
  const Float4 &a = columns[grid.index(i, j)], &b = columns[grid.index(right, j)];
  const Float4 &c = columns[grid.index(i, upper)], &d = columns[grid.index(right, upper)];
  const float wa = (1 - u) * (1 - v), wb = u * (1 - v), wc = (1 - u) * v, wd = u * v;
  return {wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y,
          wa * a.z + wb * b.z + wc * c.z + wd * d.z, wa * a.w + wb * b.w + wc * c.w + wd * d.w};
}

void apply_columns(TaskPool& pool, const ColumnGrid& grid, const std::vector<Float4>& columns, float decay,
                   std::span<const Float4> position, std::span<Float4> acceleration) {
  const float inverse_cell = 1.0f / grid.cell, inverse_decay = 1.0f / decay;
  pool.for_each_range(position.size(), kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Float4& p = position[n];
      const float gx = (p.x - grid.origin_x) * inverse_cell - 0.5f, gy = (p.y - grid.origin_y) * inverse_cell - 0.5f;
      if (!std::isfinite(gx + gy + p.z)) continue;
      const Float4 column = interpolate(grid, columns, gx, gy);
      const float decays = std::max(column.w - p.z, 0.0f) * inverse_decay;
      if (decays > kNegligibleDecays) continue;
      const float f = std::exp(-decays);
      acceleration[n].x += f * column.x;
      acceleration[n].y += f * column.y;
      acceleration[n].z += f * column.z;
    }
  });
}

}  // namespace

void Wind::push_surface(TaskPool& pool, const SurfaceGrid& surface, std::span<const Float4> position,
                        const Air::Moment& moment, std::span<Float4> acceleration) {
  const SurfaceLaw law = surface_law(around_, moment.wind);
  if (!(law.factor > 0.0) || surface.cells.empty()) return;
  fill_columns(pool, surface, air_, moment, law, column_);
  apply_columns(pool, surface.grid, column_, static_cast<float>(law.decay), position, acceleration);
}

}  // namespace pelagos
