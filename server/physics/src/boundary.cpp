#include "physics/boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/kernel.hpp"
#include "physics/neighbor_search.hpp"

namespace pelagos {

namespace {

std::array<int, 3> box_intervals(const Region& box, double spacing) {
  std::array<int, 3> intervals{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    intervals[axis] = static_cast<int>(
        std::max(1.0, std::round((static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis])) / spacing)));
  return intervals;
}

float coordinate(const Region& box, std::size_t axis, int k, int intervals) {
  const double t = static_cast<double>(k) / static_cast<double>(intervals);
  return static_cast<float>(static_cast<double>(box.min[axis]) * (1.0 - t) + static_cast<double>(box.max[axis]) * t);
}

/// Samples of the faces across walled axes; along the others they go `margin` intervals beyond.
std::vector<Float4> sample_faces(const Region& box, const std::array<Edge, 3>& edges, double spacing, int margin) {
  const std::array<int, 3> n = box_intervals(box, spacing);
  std::array<int, 3> beyond{};
  for (std::size_t axis = 0; axis < 3; ++axis) beyond[axis] = edges[axis] == Edge::kWall ? 0 : margin;
  const auto on_face = [&](std::size_t axis, int k) { return edges[axis] == Edge::kWall && (k == 0 || k == n[axis]); };
  std::vector<Float4> samples;
  for (int k = -beyond[2]; k <= n[2] + beyond[2]; ++k)
    for (int j = -beyond[1]; j <= n[1] + beyond[1]; ++j) {
      const bool whole_row = on_face(2, k) || on_face(1, j);
      for (int i = -beyond[0]; i <= n[0] + beyond[0]; ++i)
        if (whole_row || on_face(0, i))
          samples.push_back({coordinate(box, 0, i, n[0]), coordinate(box, 1, j, n[1]), coordinate(box, 2, k, n[2]), 0});
    }
  return samples;
}

Region bounds(std::span<const Float4> points) {
  Region region{{points[0].x, points[0].y, points[0].z}, {points[0].x, points[0].y, points[0].z}};
  for (const Float4& p : points) {
    const float c[3] = {p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      region.min[axis] = std::min(region.min[axis], c[axis]);
      region.max[axis] = std::max(region.max[axis], c[axis]);
    }
  }
  return region;
}

/// What a layer of samples makes of the kernel at a distance q from it (support radii), to a factor: the integral of W
/// over a plane.
double layer_sum(double q) {
  const double a = std::max(1.0 - q, 0.0), b = std::max(0.5 - q, 0.0);
  return 2.0 * (std::pow(a, 4) / 4.0 - std::pow(a, 5) / 5.0) - 8.0 * (std::pow(b, 4) / 8.0 - std::pow(b, 5) / 5.0);
}

/// How far the samples of a layer `apart` behind another count among its own, for water at `clearance` (support radii).
double far_layer_share(double apart, double clearance) {
  const double near = layer_sum(clearance) * layer_sum(apart);
  return near > 0.0 ? layer_sum(clearance + apart) * layer_sum(0.0) / near : 0.0;
}

/// V_b = 1 / sum_b' share(b, b') W_bb'.
template <class Share>
void sum_volumes(TaskPool& pool, double support_radius, std::span<Float4> samples, Share&& share) {
  if (samples.empty()) return;
  CellGrid grid(bounds(samples), support_radius);
  std::vector<std::uint32_t> order;
  grid.sort(pool, samples, order);
  std::vector<Float4> sorted(padded_count(samples.size()), Float4{1e9F, 1e9F, 1e9F, 0});
  for (std::size_t k = 0; k < samples.size(); ++k) sorted[k] = samples[order[k]];
  NeighborList list;
  const SearchSource source{&grid, sorted.data(), 0};
  find_neighbors(pool, grid, {sorted.data(), samples.size()}, {&source, 1}, static_cast<float>(support_radius),
                 static_cast<std::int32_t>(samples.size()), list);
  const CubicSpline kernel(support_radius);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    double sum = 0.0;
    for_each_neighbor(list, k, [&](std::size_t other) {
      const Float4 &a = sorted[k], &b = sorted[other];
      const auto w = static_cast<double>(kernel.value(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z)));
      sum += share(order[k], order[other]) * w;
    });
    samples[order[k]].w = static_cast<float>(1.0 / sum);
  }
}

}  // namespace

std::vector<Float4> sample_box(const Region& box, double spacing) {
  return sample_faces(box, {Edge::kWall, Edge::kWall, Edge::kWall}, spacing, 0);
}

std::vector<Float4> sample_patch_walls(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges,
                                       double spacing, double support_radius) {
  // Twice the support beyond the faces that are not walls, so that the samples that are kept have all their neighbours.
  const auto margin = static_cast<int>(std::ceil(2.0 * support_radius / spacing));
  std::vector<Float4> samples = sample_faces(patch, edges, spacing, margin);
  assign_boundary_volumes(pool, support_radius, samples);
  const float reach = static_cast<float>(support_radius) * 1.001F;
  std::erase_if(samples, [&](const Float4& p) {
    const float c[3] = {p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (c[axis] < patch.min[axis] - reach || c[axis] > patch.max[axis] + reach) return true;
    return false;
  });
  return samples;
}

void assign_boundary_volumes(TaskPool& pool, double support_radius, std::span<Float4> samples) {
  sum_volumes(pool, support_radius, samples, [](std::uint32_t, std::uint32_t) { return 1.0; });
}

void assign_boundary_volumes(TaskPool& pool, double support_radius, std::span<const Eigen::Vector3f> inward,
                             double clearance, std::span<Float4> samples) {
  const std::vector<Float4> at(samples.begin(), samples.end());
  const auto share = [&](std::uint32_t k, std::uint32_t other) {
    if (!are_opposed(inward[k], inward[other])) return 1.0;
    const Eigen::Vector3f way(at[other].x - at[k].x, at[other].y - at[k].y, at[other].z - at[k].z);
    return far_layer_share(std::abs(static_cast<double>(inward[k].dot(way))) / support_radius,
                           clearance / support_radius);
  };
  sum_volumes(pool, support_radius, samples, share);
}

std::array<std::size_t, 3> block_particles(const std::array<double, 3>& size, double spacing) {
  std::array<std::size_t, 3> n{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    n[axis] = static_cast<std::size_t>(std::max(0.0, std::round(size[axis] / spacing) - 1.0));
  return n;
}

}  // namespace pelagos
