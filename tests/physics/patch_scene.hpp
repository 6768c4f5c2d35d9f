#pragma once

#include <array>
#include <span>
#include <vector>

#include "pair_scene.hpp"
#include "physics/ghosts.hpp"

namespace pelagos::test {

inline constexpr std::array<Edge, 3> kAllWalls{Edge::kWall, Edge::kWall, Edge::kWall};

/// The same region, one reach larger on all sides: where a patch's particles and images stand.
inline Region widened(Region region, double reach) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    region.min[axis] -= static_cast<float>(reach);
    region.max[axis] += static_cast<float>(reach);
  }
  return region;
}

/// Particles in a patch with walls, mirrors or periodic faces, their images and neighbour lists, and what the corrected
/// pair passes make of them. The order is the sorted one.
class PatchScene {
 public:
  /// @param walls  V_b in w
  PatchScene(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges, std::span<const Float4> points,
             std::span<const Float4> walls, double spacing)
      : count(points.size()), d(spacing), radius(2.0 * spacing) {
    grid = wall_grid = ghosts.grid = CellGrid(widened(patch, radius), radius);
    std::vector<std::uint32_t> order;
    position = sorted(pool, grid, points, order);
    wall.position = sorted(pool, wall_grid, walls, order);
    wall.count = walls.size();
    wall.velocity.assign(padded_count(wall.count), {});
    if (has_ghosts(edges)) make_ghosts(pool, patch, edges, static_cast<float>(radius), count, position, ghosts);
    const SearchSource fluid[2] = {
        {&grid, position.data(), 0},
        {&ghosts.grid, position.data() + ghosts.begin, static_cast<std::uint32_t>(ghosts.begin)}};
    const SearchSource wall_source{&wall_grid, wall.position.data(), 0};
    const std::span<const Float4> query{position.data(), count};
    static_cast<void>(find_neighbors(pool, grid, query, {fluid, ghosts.empty() ? 1U : 2U}, static_cast<float>(radius),
                                     static_cast<std::int32_t>(count), fluid_list));
    static_cast<void>(find_neighbors(pool, grid, query, {&wall_source, 1}, static_cast<float>(radius),
                                     static_cast<std::int32_t>(wall.count), wall_list));
    data = {count,
            position.data(),
            &fluid_list,
            &wall_list,
            &wall,
            ghosts.empty() ? nullptr : &ghosts,
            true,
            static_cast<float>(radius),
            static_cast<float>(d * d * d),
            static_cast<float>(d)};
    delta.assign(padded_count(count), 0);
    refresh(pool);
  }
  PatchScene(const PatchScene&) = delete;
  PatchScene& operator=(const PatchScene&) = delete;

  /// Corrections and gradients anew, after the walls' velocities have been set.
  void refresh(TaskPool& pool) {
    compute_corrections(pool, data, delta, gradients, corrections);
    compute_corrected_gradients(pool, data, corrections, gradients);
  }
  /// The values with their images behind them.
  [[nodiscard]] std::vector<Float4> with_images(TaskPool& pool, std::vector<Float4> vectors) const {
    vectors.resize(extended_count(count, ghosts));
    extend_vectors(pool, ghosts, vectors);
    return vectors;
  }
  [[nodiscard]] std::vector<float> rate(TaskPool& pool, const std::vector<Float4>& velocity, bool moving_walls) const {
    std::vector<float> out(padded_count(count));
    compute_rate(pool, data, gradients, with_images(pool, velocity), moving_walls, out);
    return out;
  }
  [[nodiscard]] std::vector<Float4> displacement(TaskPool& pool, std::vector<float> pressure) const {
    pressure.resize(extended_count(count, ghosts));
    extend_scalars(pool, ghosts, pressure);
    std::vector<Float4> out(padded_count(count));
    apply_pressure(pool, data, gradients, pressure, out);
    return out;
  }
  [[nodiscard]] double weight(std::size_t i) const { return static_cast<double>(corrections.second[i].z); }

  std::size_t count;
  double d, radius;
  CellGrid grid, wall_grid;
  Ghosts ghosts;
  std::vector<Float4> position;
  BoundaryParticles wall;
  NeighborList fluid_list, wall_list;
  Corrections corrections;
  Gradients gradients;
  std::vector<float> delta;
  PairData data;
};

/// Particles of a lattice that fills the patch at d/2, 3d/2, ..., jittered.
inline std::vector<Float4> fill_patch(const Region& patch, double spacing, double jitter_share, std::uint32_t seed) {
  std::array<int, 3> n{};
  Double3 first{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    n[axis] = static_cast<int>(std::lround(static_cast<double>(patch.max[axis] - patch.min[axis]) / spacing));
    first[axis] = static_cast<double>(patch.min[axis]) + 0.5 * spacing;
  }
  std::vector<Float4> points = lattice(n, spacing, first);
  jitter(points, jitter_share * spacing, seed);
  return points;
}

}  // namespace pelagos::test
