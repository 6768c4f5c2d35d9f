#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "physics/neighbors.hpp"
#include "physics/particles.hpp"

namespace pelagos::test {

inline constexpr float kFar = 1e9f;

/// Fluid particles at rest at `position`, with the padding that the physics keeps.
inline FluidParticles make_fluid(const std::vector<Float4>& position) {
  FluidParticles fluid;
  fluid.count = position.size();
  fluid.position = position;
  fluid.position.resize(padded_count(position.size()), Float4{kFar, kFar, kFar, 0});
  fluid.velocity.resize(fluid.position.size());
  for (std::size_t i = 0; i < fluid.position.size(); ++i) fluid.id.push_back(static_cast<std::uint32_t>(i));
  return fluid;
}

inline BoundaryParticles make_boundary(const std::vector<Float4>& position) {
  BoundaryParticles boundary;
  boundary.count = position.size();
  boundary.position = position;
  boundary.position.resize(padded_count(position.size()), Float4{kFar, kFar, kFar, 0});
  boundary.velocity.resize(boundary.position.size());
  return boundary;
}

/// Neighbours among targets[0 .. count) closer than `radius` of each query, by comparing all with all. Lists run in
/// the order of the targets.
inline NeighborList find_neighbors_brute_force(const std::vector<Float4>& queries, std::size_t query_count,
                                               const std::vector<Float4>& targets, std::size_t count, float radius) {
  NeighborList list;
  list.dummy = static_cast<std::int32_t>(count);
  list.pair_count.assign(padded_count(query_count), 0);
  for (std::size_t first = 0; first < query_count; first += kLanes) {
    std::vector<std::vector<std::int32_t>> found(kLanes);
    std::size_t longest = 0;
    for (std::size_t lane = 0; lane < kLanes && first + lane < query_count; ++lane) {
      const Float4& q = queries[first + lane];
      for (std::size_t j = 0; j < count; ++j) {
        const float dx = targets[j].x - q.x, dy = targets[j].y - q.y, dz = targets[j].z - q.z;
        if (dx * dx + dy * dy + dz * dz < radius * radius) found[lane].push_back(static_cast<std::int32_t>(j));
      }
      list.pair_count[first + lane] = static_cast<std::uint32_t>(found[lane].size());
      longest = std::max(longest, found[lane].size());
    }
    const auto begin = static_cast<std::uint32_t>(list.slots.size() / kLanes);
    list.groups.push_back({begin, begin + static_cast<std::uint32_t>(longest)});
    for (std::size_t k = 0; k < longest; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        list.slots.push_back(k < found[lane].size() ? found[lane][k] : list.dummy);
  }
  return list;
}

}  // namespace pelagos::test
