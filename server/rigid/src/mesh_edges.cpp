#include "mesh_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>
#include <tuple>

namespace pelagos {

namespace {

constexpr double kSameAngle = 1e-6;  ///< rad: triangles round an edge that lie on one another

std::uint32_t third_vertex(const TriangleMesh& mesh, const EdgeUse& use) {
  for (const std::uint32_t vertex : mesh.triangles[use.triangle])
    if (vertex != use.low && vertex != use.high) return vertex;
  return use.low;
}

/// The uses of an edge in the order of their angles round it; where these are the same, in the order of the mesh.
std::vector<EdgeUse> sort_round_edge(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  const Eigen::Vector3d& low = mesh.vertices[uses[0].low];
  const Eigen::Vector3d axis = (mesh.vertices[uses[0].high] - low).normalized();
  const Eigen::Vector3d right = axis.unitOrthogonal(), up = axis.cross(right);
  const auto whole_turn = static_cast<std::int64_t>(std::llround(2.0 * std::numbers::pi / kSameAngle));
  std::vector<std::pair<std::int64_t, std::size_t>> order;
  for (std::size_t n = 0; n < uses.size(); ++n) {
    const Eigen::Vector3d arm = mesh.vertices[third_vertex(mesh, uses[n])] - low;
    const auto angle = static_cast<std::int64_t>(std::llround(std::atan2(arm.dot(up), arm.dot(right)) / kSameAngle));
    order.emplace_back((angle + whole_turn) % whole_turn, n);
  }
  std::sort(order.begin(), order.end());
  std::vector<EdgeUse> sorted;
  for (const auto& place : order) sorted.push_back(uses[place.second]);
  return sorted;
}

/// Joins the triangles of an edge that has as many along as back: the first along to the first back, and so on. So
/// parts that stand one after another in the mesh stay apart.
void pair_by_order(const TriangleMesh&, std::span<const EdgeUse> uses, std::vector<EdgePair>& pairs) {
  std::vector<std::uint32_t> along, back;
  for (const EdgeUse& use : uses) (use.along ? along : back).push_back(use.triangle);
  for (std::size_t n = 0; n < along.size(); ++n) pairs.push_back({along[n], back[n], true});
}

/// The same by what lies between them. The solid lies behind a triangle: with growing angle
/// it ends at those that run along the edge, and begins at those that run back.
void pair_by_angle(const TriangleMesh& mesh, std::span<const EdgeUse> uses, std::vector<EdgePair>& pairs) {
  std::vector<EdgeUse> round = sort_round_edge(mesh, uses);
  std::ptrdiff_t depth = 0, least = 0, start = 0;
  for (std::size_t n = 0; n < round.size(); ++n) {
    depth += round[n].along ? -1 : 1;
    if (depth >= least) continue;
    least = depth;
    start = static_cast<std::ptrdiff_t>(n) + 1;
  }
  std::rotate(round.begin(), round.begin() + start, round.end());
  std::deque<std::uint32_t> begun;
  for (const EdgeUse& use : round) {
    if (!use.along) {
      begun.push_back(use.triangle);
      continue;
    }
    pairs.push_back({begun.front(), use.triangle, true});
    begun.pop_front();
  }
}

/// @param shared  out: whether an edge has more than two triangles
template <class Pair>
std::vector<EdgePair> pair_all(const TriangleMesh& mesh, std::span<const EdgeUse> uses, Pair&& pair, bool& shared) {
  std::vector<EdgePair> pairs;
  pairs.reserve(uses.size() / 2);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 2)
      pairs.push_back({edge[0].triangle, edge[1].triangle, edge[0].along != edge[1].along});
    else if (2 * count_along(edge) == edge.size())
      pair(mesh, edge, pairs);
    shared = shared || edge.size() > 2;
  });
  return pairs;
}

/// How many edges have more than two triangles of one and the same part.
std::size_t count_shared_within(const TriangleMesh& mesh, std::span<const EdgeUse> uses,
                                std::span<const EdgePair> pairs) {
  const MeshShells shells = find_shells(mesh.triangles.size(), pairs);
  std::size_t count = 0;
  std::vector<std::uint32_t> parts;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() <= 2) return;
    parts.clear();
    for (const EdgeUse& use : edge) parts.push_back(shells.of[use.triangle]);
    std::sort(parts.begin(), parts.end());
    for (std::size_t n = 2; n < parts.size(); ++n)
      if (parts[n] == parts[n - 2]) {
        ++count;
        return;
      }
  });
  return count;
}

}  // namespace

std::vector<EdgeUse> collect_edges(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = corners[c], to = corners[(c + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return uses;
}

std::size_t count_along(std::span<const EdgeUse> uses) {
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const EdgeUse& use) { return use.along; }));
}

std::vector<EdgePair> pair_triangles(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  bool shared = false;
  std::vector<EdgePair> by_order = pair_all(mesh, uses, pair_by_order, shared);
  if (!shared) return by_order;
  const std::size_t left = count_shared_within(mesh, uses, by_order);
  if (left == 0) return by_order;
  std::vector<EdgePair> by_angle = pair_all(mesh, uses, pair_by_angle, shared);
  return count_shared_within(mesh, uses, by_angle) < left ? by_angle : by_order;
}

MeshShells find_shells(std::size_t triangles, std::span<const EdgePair> pairs) {
  std::vector<std::uint32_t> parent(triangles);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const EdgePair& pair : pairs) {
    const std::uint32_t a = root(pair.a), b = root(pair.b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  MeshShells shells;
  shells.of.resize(triangles);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::uint32_t first = root(t);  // the lowest of its shell
    if (first == t) {
      shells.of[t] = static_cast<std::uint32_t>(shells.first.size());
      shells.first.push_back(t);
    } else {
      shells.of[t] = shells.of[first];
    }
  }
  return shells;
}

}  // namespace pelagos
