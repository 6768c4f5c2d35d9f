#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "physics/boundary.hpp"
#include "physics/neighbor_search.hpp"
#include "physics/pair_passes.hpp"

namespace pelagos::test {

using Double3 = std::array<double, 3>;

inline Double3 as_double(const Float4& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}
inline double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Double3 minus(const Double3& a, const Double3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Points of a lattice of n[0] x n[1] x n[2] with its first point at `first`.
inline std::vector<Float4> lattice(const std::array<int, 3>& n, double spacing, const Double3& first = {0, 0, 0}) {
  std::vector<Float4> points;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        points.push_back({static_cast<float>(first[0] + i * spacing), static_cast<float>(first[1] + j * spacing),
                          static_cast<float>(first[2] + k * spacing), 0});
  return points;
}

/// The generator's bits are the same on every platform; the distributions of the library are not, hence this one.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0; }
  Float4 vector(double bound) {
    const double x = uniform(-bound, bound), y = uniform(-bound, bound), z = uniform(-bound, bound);
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
  }

 private:
  std::mt19937 engine_;
};

inline void jitter(std::vector<Float4>& points, double bound, std::uint32_t seed) {
  Random random(seed);
  for (Float4& p : points) {
    const Float4 v = random.vector(bound);
    p.x += v.x;
    p.y += v.y;
    p.z += v.z;
  }
}

inline std::vector<Float4> random_vectors(std::size_t count, double bound, std::uint32_t seed) {
  Random random(seed);
  std::vector<Float4> vectors(padded_count(count));
  for (std::size_t i = 0; i < count; ++i) vectors[i] = random.vector(bound);
  return vectors;
}

/// The points in the order of their cells, padded with far ones.
inline std::vector<Float4> sorted(TaskPool& pool, CellGrid& by, std::span<const Float4> points,
                                  std::vector<std::uint32_t>& order) {
  by.sort(pool, points, order);
  std::vector<Float4> out(padded_count(points.size()), Float4{1e9F, 1e9F, 1e9F, 0});
  for (std::size_t k = 0; k < points.size(); ++k) out[k] = points[order[k]];
  return out;
}

/// Fluid and wall points, sorted and with neighbour lists: all that a pair pass needs. The order is the sorted one.
class PairScene {
 public:
  /// @param walls  V_b in w
  PairScene(TaskPool& pool, std::span<const Float4> points, std::span<const Float4> walls, double spacing,
            double support_radius)
      : count(points.size()), d(spacing), radius(support_radius) {
    Region region{{0, 0, 0}, {1, 1, 1}};
    if (!points.empty()) {
      region = {{points[0].x, points[0].y, points[0].z}, {points[0].x, points[0].y, points[0].z}};
      for (const Float4& p : points) {
        const float c[3] = {p.x, p.y, p.z};
        for (int axis = 0; axis < 3; ++axis) {
          region.min[axis] = std::min(region.min[axis], c[axis]);
          region.max[axis] = std::max(region.max[axis], c[axis]);
        }
      }
    }
    grid = wall_grid = CellGrid(region, support_radius);
    std::vector<std::uint32_t> order;
    position = sorted(pool, grid, points, order);
    wall.position = sorted(pool, wall_grid, walls, order);
    wall.count = walls.size();
    wall.velocity.assign(padded_count(walls.size()), {});
    const SearchSource fluid_source{&grid, position.data(), 0}, wall_source{&wall_grid, wall.position.data(), 0};
    const std::span<const Float4> query{position.data(), count};
    report = find_neighbors(pool, grid, query, {&fluid_source, 1}, static_cast<float>(radius),
                            static_cast<std::int32_t>(count), fluid_list);
    static_cast<void>(find_neighbors(pool, grid, query, {&wall_source, 1}, static_cast<float>(radius),
                                     static_cast<std::int32_t>(wall.count), wall_list));
    data = {count,
            position.data(),
            &fluid_list,
            &wall_list,
            &wall,
            nullptr,
            true,
            static_cast<float>(radius),
            static_cast<float>(d * d * d),
            static_cast<float>(d)};
    delta.assign(padded_count(count), 0);
    compute_density(pool, data, delta, gradients);
  }
  PairScene(const PairScene&) = delete;
  PairScene& operator=(const PairScene&) = delete;

  [[nodiscard]] std::vector<float> rate(TaskPool& pool, std::span<const Float4> velocity, bool moving_walls) const {
    std::vector<float> out(padded_count(count));
    compute_rate(pool, data, gradients, velocity, moving_walls, out);
    return out;
  }
  [[nodiscard]] std::vector<Float4> displacement(TaskPool& pool, std::span<const float> pressure) const {
    std::vector<Float4> out(padded_count(count));
    apply_pressure(pool, data, gradients, pressure, out);
    return out;
  }

  std::size_t count;
  double d, radius;
  CellGrid grid, wall_grid;
  std::vector<Float4> position;
  BoundaryParticles wall;
  NeighborList fluid_list, wall_list;
  SearchReport report;
  Gradients gradients;
  std::vector<float> delta;
  PairData data;
};

/// Cubic spline in double precision, written by pieces (Monaghan 1992): independent of the library's form.
struct ReferenceSpline {
  double radius;
  [[nodiscard]] double sigma() const { return 8.0 / (M_PI * radius * radius * radius); }
  [[nodiscard]] double value(double r) const {
    const double q = r / radius;
    if (q >= 1.0) return 0.0;
    return sigma() * (q <= 0.5 ? 6.0 * (q * q * q - q * q) + 1.0 : 2.0 * (1.0 - q) * (1.0 - q) * (1.0 - q));
  }
  [[nodiscard]] double derivative(double r) const {
    const double q = r / radius;
    if (q >= 1.0) return 0.0;
    return sigma() / radius * (q <= 0.5 ? 6.0 * (3.0 * q * q - 2.0 * q) : -6.0 * (1.0 - q) * (1.0 - q));
  }
  /// grad W with respect to the first point, for x = x_i - x_j.
  [[nodiscard]] Double3 gradient(const Double3& x) const {
    const double r = std::sqrt(dot(x, x));
    if (r <= 0.0) return {0, 0, 0};
    const double factor = derivative(r) / r;
    return {factor * x[0], factor * x[1], factor * x[2]};
  }
};

}  // namespace pelagos::test
