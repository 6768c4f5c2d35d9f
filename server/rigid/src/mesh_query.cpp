#include "rigid/mesh_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pelagos {

namespace {

constexpr std::size_t kMostPairs = 50'000'000;  ///< whose boxes meet, of triangles that may cut each other
constexpr double kParallel = 1e-9;              ///< sine of the angle below which an edge lies in a triangle's plane
constexpr std::size_t kDeepest = 64;            ///< of the tree: halving reaches 4 triangles after log2(n) levels

/// The place of a triangle nearest to a point, by the regions of its plane (Ericson 2005, Real-Time Collision
/// Detection, section 5.1.5).
Eigen::Vector3d nearest_place(const Eigen::Vector3d& point, const Eigen::Vector3d& corner, const Eigen::Vector3d& ab,
                              const Eigen::Vector3d& ac) {
  const Eigen::Vector3d ap = point - corner;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return corner;
  const Eigen::Vector3d bp = ap - ab;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return corner + ab;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return corner + ab * (d1 / (d1 - d3));
  const Eigen::Vector3d cp = ap - ac;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return corner + ac;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return corner + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return corner + ab + (ac - ab) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double scale = 1.0 / (va + vb + vc);
  return corner + ab * (vb * scale) + ac * (vc * scale);
}

/// Where the ray meets the triangle, as a distance along it; negative if it does not (Moeller & Trumbore 1997).
double ray_distance(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, const Eigen::Vector3d& corner,
                    const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
  const Eigen::Vector3d p = direction.cross(edge2);
  const double determinant = edge1.dot(p);
  if (determinant == 0.0) return -1.0;
  const Eigen::Vector3d s = start - corner;
  const double u = s.dot(p) / determinant;
  if (u < 0.0 || u > 1.0) return -1.0;
  const Eigen::Vector3d q = s.cross(edge1);
  const double v = direction.dot(q) / determinant;
  if (v < 0.0 || u + v > 1.0) return -1.0;
  return edge2.dot(q) / determinant;
}

bool share_vertex(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return std::any_of(a.begin(), a.end(), [&](std::uint32_t v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

Eigen::AlignedBox3d box_of(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
  Eigen::AlignedBox3d box(corner);
  return box.extend(corner + edge1).extend(corner + edge2);
}

/// Whether an edge of the first triangle goes through the second.
bool pierces(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2,
             const Eigen::Vector3d& other, const Eigen::Vector3d& other1, const Eigen::Vector3d& other2) {
  const Eigen::Vector3d normal = other1.cross(other2);
  const auto meets = [&](const Eigen::Vector3d& start, const Eigen::Vector3d& way) {
    if (std::abs(way.dot(normal)) <= kParallel * way.norm() * normal.norm()) return false;
    const double at = ray_distance(start, way, other, other1, other2);
    return at >= 0.0 && at <= 1.0;
  };
  return meets(corner, edge1) || meets(corner, edge2) || meets(corner + edge1, edge2 - edge1);
}

bool ray_meets_box(const Eigen::Vector3d& start, const Eigen::Vector3d& inverse, const Eigen::AlignedBox3d& box) {
  const Eigen::Array3d near = (box.min() - start).array() * inverse.array();
  const Eigen::Array3d far = (box.max() - start).array() * inverse.array();
  const double enter = near.min(far).maxCoeff(), leave = near.max(far).minCoeff();
  return leave >= std::max(enter, 0.0);
}

}  // namespace

MeshQuery::MeshQuery(const TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Eigen::AlignedBox3d> boxes(count);
  std::vector<Eigen::Vector3d> centres(count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t c = 0; c < 3; ++c) boxes[t].extend(mesh.corner(t, c));
    centres[t] = mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2);
  }
  std::vector<std::uint32_t> order;
  nodes_ = build_box_nodes(boxes, centres, order);
  for (BoxNode& node : nodes_) {
    // A hair of margin, so that rounding in the ray test never misses a triangle that lies in the box's face.
    const double margin = 1e-12 * node.box.sizes().maxCoeff();
    node.box = Eigen::AlignedBox3d(node.box.min().array() - margin, node.box.max().array() + margin);
  }
  triangles_.reserve(count);
  for (const std::uint32_t t : order)
    triangles_.push_back({mesh.corner(t, 0), mesh.corner(t, 1) - mesh.corner(t, 0),
                          mesh.corner(t, 2) - mesh.corner(t, 0), t, mesh.triangles[t]});
  box_ = nodes_[0].box;
}

template <class Visit>
void MeshQuery::for_each_near(const Eigen::Vector3d& point, double limit_squared, Visit&& visit) const {
  std::array<std::uint32_t, kDeepest> stack{};
  std::size_t depth = 0;
  if (!triangles_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const BoxNode& node = nodes_[stack[--depth]];
    if (node.box.squaredExteriorDistance(point) >= limit_squared) continue;
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
      limit_squared =
          visit(triangles_[t], nearest_place(point, triangles_[t].corner, triangles_[t].edge1, triangles_[t].edge2));
    if (node.count > 0) continue;
    const bool second_nearer = nodes_[node.first + 1].box.squaredExteriorDistance(point) <
                               nodes_[node.first].box.squaredExteriorDistance(point);
    stack[depth++] = node.first + (second_nearer ? 0 : 1);
    stack[depth++] = node.first + (second_nearer ? 1 : 0);
  }
}

double MeshQuery::distance(const Eigen::Vector3d& point, double limit) const {
  double nearest = limit * limit;
  for_each_near(point, nearest, [&](const Triangle&, const Eigen::Vector3d& place) {
    nearest = std::min(nearest, (point - place).squaredNorm());
    return nearest;
  });
  return std::sqrt(nearest);
}

std::optional<NearestPlace> MeshQuery::nearest(const Eigen::Vector3d& point, double limit) const {
  constexpr double kSlack = 1.0 + 1e-9;  // of a squared distance: nearer by less is as near
  double squared_limit = limit * limit;
  std::optional<NearestPlace> found;
  for_each_near(point, squared_limit, [&](const Triangle& triangle, const Eigen::Vector3d& place) {
    const double squared = (point - place).squaredNorm(), best = found ? found->distance : limit * limit;
    const Eigen::Vector3d normal = triangle.normal();
    const double above = normal.dot(point - place);
    const bool nearer = squared * kSlack < best;
    if (nearer || (found && squared <= best * kSlack && std::abs(above) > std::abs(found->height)))
      found = {place, normal, nearer ? squared : std::min(squared, best), above};
    if (found) squared_limit = found->distance * kSlack * kSlack;
    return squared_limit;
  });
  if (found) found->distance = std::sqrt(found->distance);
  return found;
}

bool MeshQuery::behind(const Eigen::Vector3d& point) const {
  const auto found = nearest(point, std::numeric_limits<double>::infinity());
  return found && found->height < 0.0;
}

template <class Visit>
void MeshQuery::for_each_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, Visit&& visit) const {
  // A tiny number for zero keeps the box test free of 0 * infinity.
  const Eigen::Vector3d inverse = direction.unaryExpr([](double c) { return 1.0 / (c == 0.0 ? 1e-300 : c); });
  std::array<std::uint32_t, kDeepest> stack{};
  std::size_t depth = 0;
  if (!triangles_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const BoxNode& node = nodes_[stack[--depth]];
    if (!ray_meets_box(start, inverse, node.box)) continue;
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
      const double hit = ray_distance(start, direction, triangles_[t].corner, triangles_[t].edge1, triangles_[t].edge2);
      if (hit >= 0.0) visit(hit, triangles_[t]);
    }
    if (node.count > 0) continue;
    stack[depth++] = node.first;
    stack[depth++] = node.first + 1;
  }
}

double MeshQuery::first_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, double skip) const {
  double first = std::numeric_limits<double>::infinity();
  for_each_hit(start, direction, [&](double hit, const Triangle&) {
    if (hit > skip && hit < first) first = hit;
  });
  return first;
}

bool MeshQuery::inside(const Eigen::Vector3d& point) const {
  if (!box_.contains(point)) return false;
  static const std::array<Eigen::Vector3d, 3> kDirections{Eigen::Vector3d(0.8342, 0.3571, 0.4203).normalized(),
                                                          Eigen::Vector3d(-0.2917, 0.8113, -0.5066).normalized(),
                                                          Eigen::Vector3d(-0.4719, -0.3329, 0.8164).normalized()};
  int votes = 0;
  for (const Eigen::Vector3d& direction : kDirections) {
    int windings = 0;
    for_each_hit(point, direction, [&](double, const Triangle& triangle) {
      windings += direction.dot(triangle.edge1.cross(triangle.edge2)) > 0.0 ? 1 : -1;
    });
    votes += windings > 0 ? 1 : 0;
  }
  return votes >= 2;
}

template <class Visit>
void MeshQuery::for_each_in(const Eigen::AlignedBox3d& box, Visit&& visit) const {
  std::array<std::uint32_t, kDeepest> stack{};
  std::size_t depth = 0;
  if (!triangles_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const BoxNode& node = nodes_[stack[--depth]];
    if (!node.box.intersects(box)) continue;
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t) visit(triangles_[t]);
    if (node.count > 0) continue;
    stack[depth++] = node.first;
    stack[depth++] = node.first + 1;
  }
}

SelfIntersections MeshQuery::find_self_intersections(std::span<const std::uint32_t> part) const {
  SelfIntersections found;
  std::size_t looked = 0;
  found.first.fill(std::numeric_limits<std::uint32_t>::max());
  for (const Triangle& a : triangles_) {
    if (looked > kMostPairs) {
      found.all = false;
      break;
    }
    const Eigen::AlignedBox3d box = box_of(a.corner, a.edge1, a.edge2);
    for_each_in(box, [&](const Triangle& b) {
      ++looked;
      if (b.number <= a.number || share_vertex(a.vertices, b.vertices)) return;
      if (!part.empty() && part[a.number] != part[b.number]) return;
      if (!pierces(a.corner, a.edge1, a.edge2, b.corner, b.edge1, b.edge2) &&
          !pierces(b.corner, b.edge1, b.edge2, a.corner, a.edge1, a.edge2))
        return;
      ++found.pairs;
      found.first = std::min(found.first, std::array<std::uint32_t, 2>{a.number, b.number});
    });
  }
  return found;
}

}  // namespace pelagos
