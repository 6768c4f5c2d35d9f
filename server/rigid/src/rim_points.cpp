#include "rim_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "box_tree.hpp"
#include "mesh_edges.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kMostRim = 50'000;      ///< edges: a mesh with more has no gaps, it is in pieces
constexpr std::size_t kMostWork = 3'000'000;  ///< boxes looked at: far below a second

/// A vertex on an edge, and how far along it.
struct PointOnEdge {
  double share;
  std::uint32_t vertex;
};

/// Finds the vertices of rims that lie on an edge.
class RimPoints {
 public:
  RimPoints(const TriangleMesh& mesh, const std::vector<EdgeUse>& rim, double distance)
      : mesh_(mesh), distance_(distance), vertices_(vertices_of(rim)), tree_(boxes_of(mesh, vertices_)) {}

  /// In the order from one vertex to the other.
  [[nodiscard]] std::vector<PointOnEdge> on(std::uint32_t from, std::uint32_t to, std::size_t& work) const {
    const Eigen::Vector3d &start = mesh_.vertices[from], way = mesh_.vertices[to] - start;
    Eigen::AlignedBox3d reach(start);
    reach.extend(mesh_.vertices[to]);
    reach = {reach.min().array() - distance_, reach.max().array() + distance_};
    std::vector<PointOnEdge> points;
    const auto meets = [&](const Eigen::AlignedBox3d& box) { return ++work <= kMostWork && box.intersects(reach); };
    tree_.for_each(meets, [&](std::uint32_t n) {
      const Eigen::Vector3d arm = mesh_.vertices[vertices_[n]] - start;
      const double share = arm.dot(way) / way.squaredNorm(), margin = distance_ / way.norm();
      if (share > margin && share < 1.0 - margin && (arm - share * way).norm() <= distance_)
        points.push_back({share, vertices_[n]});
    });
    std::sort(points.begin(), points.end(), [](const PointOnEdge& a, const PointOnEdge& b) {
      return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
    });
    return points;
  }

 private:
  static std::vector<std::uint32_t> vertices_of(const std::vector<EdgeUse>& rim) {
    std::vector<std::uint32_t> vertices;
    for (const EdgeUse& edge : rim) vertices.insert(vertices.end(), {edge.low, edge.high});
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }
  static std::vector<Eigen::AlignedBox3d> boxes_of(const TriangleMesh& mesh,
                                                   const std::vector<std::uint32_t>& vertices) {
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) boxes.emplace_back(mesh.vertices[vertex]);
    return boxes;
  }

  const TriangleMesh& mesh_;
  double distance_;
  std::vector<std::uint32_t> vertices_;
  BoxTree tree_;
};

std::vector<EdgeUse> find_rim(const TriangleMesh& mesh) {
  std::vector<EdgeUse> rim;
  const std::vector<EdgeUse> uses = collect_edges(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 1) rim.push_back(edge[0]);
  });
  return rim;
}

/// Puts triangles that all have the corner across from an edge in the place of one.
void divide(TriangleMesh& mesh, MeshOrigin& origin, const EdgeUse& edge, const std::vector<PointOnEdge>& points) {
  auto corners = mesh.triangles[edge.triangle];
  while (std::min(corners[0], corners[1]) != edge.low || std::max(corners[0], corners[1]) != edge.high)
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  std::uint32_t from = corners[0];
  for (const PointOnEdge& point : points) {
    mesh.triangles.push_back({from, point.vertex, corners[2]});
    if (edge.triangle < origin.part.size()) {
      origin.part.push_back(origin.part[edge.triangle]);
      origin.place.push_back(origin.place[edge.triangle]);
    }
    from = point.vertex;
  }
  mesh.triangles[edge.triangle] = {from, corners[1], corners[2]};
}

/// Divides each triangle at one of its edges. @return whether there may be more to divide
bool divide_once(TriangleMesh& mesh, MeshOrigin& origin, double distance, std::size_t most, std::size_t& work) {
  const std::vector<EdgeUse> rim = find_rim(mesh);
  if (rim.empty() || rim.size() > kMostRim) return false;
  const RimPoints rim_points(mesh, rim, distance);
  struct Division {
    EdgeUse edge;
    std::vector<PointOnEdge> points;
  };
  std::vector<Division> divisions;
  std::vector<bool> taken(mesh.triangles.size(), false);
  std::size_t added = 0;
  for (const EdgeUse& edge : rim) {
    if (taken[edge.triangle]) continue;
    auto points = edge.along ? rim_points.on(edge.low, edge.high, work) : rim_points.on(edge.high, edge.low, work);
    if (work > kMostWork) return false;
    std::erase_if(points, [&](const PointOnEdge& point) {  // of the triangle itself
      return std::count(mesh.triangles[edge.triangle].begin(), mesh.triangles[edge.triangle].end(), point.vertex) > 0;
    });
    if (points.empty()) continue;
    taken[edge.triangle] = true;
    added += points.size();
    divisions.push_back({edge, std::move(points)});
  }
  if (mesh.triangles.size() + added > most) return false;
  for (const Division& division : divisions) divide(mesh, origin, division.edge, division.points);
  return !divisions.empty();
}

}  // namespace

void divide_at_rim_points(TriangleMesh& mesh, MeshOrigin& origin, double distance) {
  constexpr int kPasses = 4;  // one for each edge of a triangle, and one to see that none is left
  const std::size_t most = 2 * mesh.triangles.size();
  std::size_t work = 0;
  for (int pass = 0; pass < kPasses; ++pass)
    if (!divide_once(mesh, origin, distance, most, work)) return;
}

}  // namespace pelagos
