#include "rigid/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

namespace pelagos {

namespace {

/// Points in a hash of cells, three merging distances wide, so that most are far from the sides of theirs.
class PointHash {
 public:
  PointHash(std::size_t most, double distance)
      : distance_(distance), cell_(std::max(3.0 * distance, 1e-300)), heads_(std::bit_ceil(most + 1), kNone) {}

  /// The first of the points given so far that is no farther than the distance; the point itself if none is.
  std::uint32_t find_or_add(const Eigen::Vector3d& point, std::vector<Eigen::Vector3d>& points) {
    const Eigen::Vector3d low = cell_of(point.array() - distance_), high = cell_of(point.array() + distance_);
    std::uint32_t match = kNone;
    for (double x = low.x(); x <= high.x(); ++x)
      for (double y = low.y(); y <= high.y(); ++y)
        for (double z = low.z(); z <= high.z(); ++z)
          for (std::uint32_t n = heads_[bucket({x, y, z})]; n != kNone; n = next_[n])
            if ((points[n] - point).norm() <= distance_) match = std::min(match, n);
    if (match != kNone) return match;
    const auto added = static_cast<std::uint32_t>(points.size());
    points.push_back(point);
    std::uint32_t& head = heads_[bucket(cell_of(point))];
    next_.push_back(head);
    head = added;
    return added;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Whole numbers below 2^50: a step of one is a step.
  [[nodiscard]] Eigen::Vector3d cell_of(const Eigen::Array3d& point) const {
    return (point / cell_).floor().max(-1e15).min(1e15);
  }
  [[nodiscard]] std::size_t bucket(const Eigen::Vector3d& cell) const {
    std::uint64_t hash = 1469598103934665603u;
    for (const double part : {cell.x(), cell.y(), cell.z()}) {
      hash = (hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(part))) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 31;
    }
    return hash & (heads_.size() - 1);
  }

  double distance_, cell_;
  std::vector<std::uint32_t> heads_, next_;  ///< first point of each bucket, next point after each
};

}  // namespace

TriangleMesh weld_vertices(const TriangleMesh& mesh, double distance) {
  TriangleMesh welded;
  PointHash known(mesh.vertices.size(), distance);
  std::vector<std::uint32_t> renamed;
  renamed.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) renamed.push_back(known.find_or_add(vertex, welded.vertices));
  welded.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) welded.triangles.push_back({renamed[a], renamed[b], renamed[c]});
  return welded;
}

namespace {

constexpr std::uint32_t kUnused = ~std::uint32_t{0};

/// The triangles that `chosen` says, with the vertices that they use in the order of their first use.
/// @param renamed  [vertices] of kUnused, before and after
TriangleMesh take_triangles(const TriangleMesh& mesh, const std::vector<std::uint32_t>& chosen,
                            std::vector<std::uint32_t>& renamed) {
  TriangleMesh taken;
  taken.triangles.reserve(chosen.size());
  for (const std::uint32_t t : chosen) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh.triangles[t][c];
      if (renamed[vertex] == kUnused) {
        renamed[vertex] = static_cast<std::uint32_t>(taken.vertices.size());
        taken.vertices.push_back(mesh.vertices[vertex]);
      }
      triangle[c] = renamed[vertex];
    }
    taken.triangles.push_back(triangle);
  }
  for (const std::uint32_t t : chosen)
    for (const std::uint32_t vertex : mesh.triangles[t]) renamed[vertex] = kUnused;
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
void put_triangles(const TriangleMesh& part, const std::vector<std::uint32_t>& chosen, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (std::size_t n = 0; n < chosen.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) mesh.triangles[chosen[n]][c] = first + part.triangles[n][c];
}

}  // namespace

TriangleMesh weld_parts(const TriangleMesh& mesh, std::span<const std::uint32_t> part, double distance) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> triangles_of;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles_of[part[t]].push_back(t);
  std::vector<std::uint32_t> renamed(mesh.vertices.size(), kUnused), open;
  if (triangles_of.size() == 1)
    return weld_vertices(take_triangles(mesh, triangles_of.begin()->second, renamed), distance);
  TriangleMesh welded;
  welded.triangles.resize(mesh.triangles.size());
  for (const auto& [number, triangles] : triangles_of) {
    const TriangleMesh alone = weld_vertices(take_triangles(mesh, triangles, renamed), distance);
    if (is_closed(alone))
      put_triangles(alone, triangles, welded);
    else
      open.insert(open.end(), triangles.begin(), triangles.end());
  }
  if (!open.empty()) put_triangles(weld_vertices(take_triangles(mesh, open, renamed), distance), open, welded);
  return welded;
}

std::string MeshOrigin::describe(std::size_t triangle) const {
  if (triangle >= part.size()) return "triangle " + std::to_string(triangle + 1);
  const std::uint32_t own = part[triangle];
  const std::string words = place_name[own] + " " + std::to_string(place[triangle]);
  return parts[own].empty() ? words : words + " of " + parts[own];
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
