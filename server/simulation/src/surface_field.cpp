#include "simulation/surface_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pelagos {

void SurfaceField::build(const FluidState& fluid, double fallback_level) {
  const FluidParticles& p = fluid.particles;
  const auto spacing = static_cast<float>(fluid.parameters.spacing);
  grid_ = make_column_grid({p.position.data(), p.count}, 2.0F * spacing);
  find_highest(grid_, {p.position.data(), p.count}, highest_);
  cells_.assign(grid_.cell_count(), {});
  for (int j = 0; j < grid_.rows; ++j)
    for (int i = 0; i < grid_.columns; ++i)
      cells_[grid_.index(i, j)].surface =
          surface_height(grid_, highest_, i, j, 2.0F * spacing, static_cast<float>(fallback_level));
  measure_velocities(fluid);
  for (Cell& cell : cells_) cell.surface += 0.5F * spacing;
}

void SurfaceField::measure_velocities(const FluidState& fluid) {
  const FluidParticles& p = fluid.particles;
  const auto spacing = static_cast<float>(fluid.parameters.spacing);
  const float inverse = 1.0F / grid_.cell;
  for (std::size_t n = 0; n < p.count; ++n) {
    const Float4 &x = p.position[n], &v = p.velocity[n];
    const float gx = (x.x - grid_.origin_x) * inverse, gy = (x.y - grid_.origin_y) * inverse;
    if (!(gx >= 0.0F && gy >= 0.0F && gx < static_cast<float>(grid_.columns) && gy < static_cast<float>(grid_.rows)))
      continue;
    Cell& cell = cells_[grid_.index(static_cast<int>(gx), static_cast<int>(gy))];
    if (!(x.z > cell.surface - spacing && x.z <= cell.surface + 0.5F * spacing)) continue;
    if (!std::isfinite(v.x + v.y + v.z)) continue;
    cell.momentum += Eigen::Vector3f(v.x, v.y, v.z).cast<double>();
    ++cell.count;
  }
}

std::optional<SurfaceField::Sample> SurfaceField::at(const Eigen::Vector2d& local) const {
  if (cells_.empty() || !local.allFinite()) return std::nullopt;
  const double gx = (local.x() - static_cast<double>(grid_.origin_x)) / static_cast<double>(grid_.cell) - 0.5;
  const double gy = (local.y() - static_cast<double>(grid_.origin_y)) / static_cast<double>(grid_.cell) - 0.5;
  if (gx < -1.5 || gy < -1.5 || gx > grid_.columns + 0.5 || gy > grid_.rows + 0.5) return std::nullopt;
  const int i = static_cast<int>(std::floor(gx)), j = static_cast<int>(std::floor(gy));
  const double u = gx - i, v = gy - j;
  const std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  Sample sample;
  double total = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int a = std::clamp(i + corner % 2, 0, grid_.columns - 1), b = std::clamp(j + corner / 2, 0, grid_.rows - 1);
    const Cell& cell = cells_[grid_.index(a, b)];
    if (cell.count == 0) continue;
    const double weight = std::max(weights[static_cast<std::size_t>(corner)], 1e-9);
    sample.height += weight * static_cast<double>(cell.surface);
    sample.velocity += weight / cell.count * cell.momentum;
    total += weight;
  }
  if (total == 0.0) return std::nullopt;
  sample.height /= total;
  sample.velocity /= total;
  return sample;
}

Eigen::Vector3d SurfaceField::mean_velocity() const {
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Cell& cell : cells_) {
    momentum += cell.momentum;
    count += cell.count;
  }
  return count > 0 ? Eigen::Vector3d(momentum / count) : momentum;
}

}  // namespace pelagos
