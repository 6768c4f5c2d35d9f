#include "rigid/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace pelagos {

TriangleMesh weld_vertices(const TriangleMesh& mesh, double distance) {
  // Vertices in a hash of cells of the merging distance; a match may lie in any of the 27 cells around.
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t hash = 1469598103934665603u;
      for (const std::int64_t part : cell) hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u;
      return static_cast<std::size_t>(hash ^ (hash >> 31));
    }
  };
  const double cell_size = std::max(distance, 1e-300);
  const Eigen::Vector3d origin = mesh.vertices.empty() ? Eigen::Vector3d::Zero() : mesh.vertices.front();
  const auto cell_of = [&](const Eigen::Vector3d& point) {
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          std::llround(std::clamp(std::floor((point[axis] - origin[axis]) / cell_size), -4e18, 4e18));
    return cell;
  };
  TriangleMesh welded;
  std::unordered_map<Cell, std::uint32_t, CellHash> known;
  std::vector<std::uint32_t> renamed(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector3d& point = mesh.vertices[v];
    const Cell home = cell_of(point);
    std::int64_t match = -1;
    for (int n = 0; n < 27 && match < 0; ++n) {
      const Cell cell{home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1};
      const auto found = known.find(cell);
      if (found != known.end() && (welded.vertices[found->second] - point).norm() <= distance) match = found->second;
    }
    if (match < 0) {
      match = static_cast<std::int64_t>(welded.vertices.size());
      welded.vertices.push_back(point);
      known.emplace(home, static_cast<std::uint32_t>(match));
    }
    renamed[v] = static_cast<std::uint32_t>(match);
  }
  welded.triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    welded.triangles.push_back({renamed[triangle[0]], renamed[triangle[1]], renamed[triangle[2]]});
  return welded;
}

namespace {

/// The triangles that `chosen` says, with the vertices that they use in the order of their first use.
TriangleMesh take_triangles(const TriangleMesh& mesh, const std::vector<std::size_t>& chosen) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::unordered_map<std::uint32_t, std::uint32_t> renamed;
  TriangleMesh taken;
  taken.triangles.reserve(chosen.size());
  for (const std::size_t t : chosen) {
    std::array<std::uint32_t, 3> triangle{kUnused, kUnused, kUnused};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh.triangles[t][c];
      const auto [known, is_new] = renamed.try_emplace(vertex, static_cast<std::uint32_t>(taken.vertices.size()));
      if (is_new) taken.vertices.push_back(mesh.vertices[vertex]);
      triangle[c] = known->second;
    }
    taken.triangles.push_back(triangle);
  }
  return taken;
}

/// Whether no edge ends at a rim: each has an even number of triangles, whichever way they face.
bool is_closed(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangle[c], triangle[(c + 1) % 3]);
      if (low != high) edges.push_back({low, high});
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t n = 0; n < edges.size();) {
    const std::size_t start = n;
    while (n < edges.size() && edges[n] == edges[start]) ++n;
    if ((n - start) % 2 != 0) return false;
  }
  return !edges.empty();
}

/// Appends with the triangles at the places that `chosen` says.
void put_triangles(const TriangleMesh& part, const std::vector<std::size_t>& chosen, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (std::size_t n = 0; n < chosen.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) mesh.triangles[chosen[n]][c] = first + part.triangles[n][c];
}

}  // namespace

TriangleMesh weld_parts(const TriangleMesh& mesh, std::span<const std::uint32_t> part, double distance) {
  std::map<std::uint32_t, std::vector<std::size_t>> triangles_of;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) triangles_of[part[t]].push_back(t);
  TriangleMesh welded;
  welded.triangles.resize(mesh.triangles.size());
  std::vector<std::size_t> open;
  for (const auto& [number, triangles] : triangles_of) {
    const TriangleMesh alone = weld_vertices(take_triangles(mesh, triangles), distance);
    if (is_closed(alone))
      put_triangles(alone, triangles, welded);
    else
      open.insert(open.end(), triangles.begin(), triangles.end());
  }
  put_triangles(weld_vertices(take_triangles(mesh, open), distance), open, welded);
  return welded;
}

std::string MeshOrigin::describe(std::size_t triangle) const {
  if (triangle >= part.size()) return "triangle " + std::to_string(triangle + 1);
  const std::uint32_t own = part[triangle];
  return place_name[own] + " " + std::to_string(place[triangle]) + " of " + parts[own];
}

double mesh_volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    volume += (mesh.corner(t, 0) - mesh.vertices.front()).dot(mesh.area_vector(t)) / 3.0;
  return volume;
}

double mesh_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area_vector(t).norm();
  return area;
}

std::vector<std::array<std::uint32_t, 2>> rim_edges(const TriangleMesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, int> edges;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangle[c], triangle[(c + 1) % 3]);
      ++edges[{low, high}];
    }
  std::vector<std::array<std::uint32_t, 2>> rim;
  for (const auto& [edge, count] : edges)
    if (count == 1) rim.push_back(edge);
  return rim;
}

}  // namespace pelagos
