#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kFaultsShown = 3;  ///< of each kind
constexpr double kFarthest = 1e6;        ///< m, of a coordinate
constexpr double kLeastArea = 1e-12;     ///< of the size squared: less is no triangle

/// Collects faults of one kind: the first few in words, the rest as a number.
class FaultList {
 public:
  explicit FaultList(std::string kind) : kind_(std::move(kind)) {}
  void add(const std::string& text) {
    if (++count_ <= kFaultsShown) shown_.push_back(kind_ + ": " + text);
  }
  void append_to(std::vector<std::string>& faults) const {
    faults.insert(faults.end(), shown_.begin(), shown_.end());
    if (count_ > kFaultsShown)
      faults.push_back(kind_ + ": " + std::to_string(count_ - kFaultsShown) + " more, " + std::to_string(count_) +
                       " in all");
  }

 private:
  std::string kind_;
  std::vector<std::string> shown_;
  std::size_t count_ = 0;
};

std::string text_of(const Eigen::Vector3d& point) {
  std::ostringstream text;
  text << '(' << point.x() << ", " << point.y() << ", " << point.z() << ") m";
  return text.str();
}

Eigen::Vector3d size_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box.sizes();
}

/// An edge, from its lower to its higher vertex, and the triangles that have it: those that run along it, and back.
using Edge = std::pair<std::uint32_t, std::uint32_t>;
struct EdgeTriangles {
  std::vector<std::size_t> along, back;
  [[nodiscard]] std::size_t count() const { return along.size() + back.size(); }
};
using EdgeMap = std::map<Edge, EdgeTriangles>;

EdgeMap collect_edges(const TriangleMesh& mesh) {
  EdgeMap edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, d] = mesh.triangles[t];
    if (a == b || b == d || d == a) continue;  // collapsed: its neighbours meet where it was
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = mesh.triangles[t][c], to = mesh.triangles[t][(c + 1) % 3];
      EdgeTriangles& edge = edges[std::minmax(from, to)];
      (from < to ? edge.along : edge.back).push_back(t);
    }
  }
  return edges;
}

void check_numbers(const TriangleMesh& mesh, std::vector<std::string>& faults) {
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      if (vertex >= mesh.vertices.size()) {
        faults.push_back("a triangle names vertex " + std::to_string(vertex) + " of none");
        return;
      }
  FaultList absurd("vertex out of range");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite() || mesh.vertices[v].cwiseAbs().maxCoeff() > kFarthest)
      absurd.add("vertex " + std::to_string(v + 1) + " lies at " + text_of(mesh.vertices[v]) +
                 ", allowed are finite coordinates up to 1e6 m");
  absurd.append_to(faults);
}

void check_areas(const TriangleMesh& mesh, const MeshOrigin& origin, std::vector<std::string>& faults) {
  const double least = kLeastArea * size_of(mesh).squaredNorm();
  FaultList degenerate("degenerate triangle");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!(mesh.area_vector(t).norm() > least))
      degenerate.add(origin.describe(t) + " at " + text_of(mesh.corner(t, 0)) + " has no area");
  degenerate.append_to(faults);
}

void check_edges(const TriangleMesh& mesh, const EdgeMap& edges, MeshKind kind, const MeshOrigin& origin,
                 std::vector<std::string>& faults) {
  FaultList open("open edge"), shared("edge shared by too many triangles");
  for (const auto& [edge, triangles] : edges) {
    const std::string place =
        "from " + text_of(mesh.vertices[edge.first]) + " to " + text_of(mesh.vertices[edge.second]);
    if (triangles.count() == 1 && kind == MeshKind::kClosed) {
      const std::size_t only = triangles.along.empty() ? triangles.back[0] : triangles.along[0];
      open.add("only " + origin.describe(only) + " has the edge " + place);
    }
    if (triangles.count() > 2) shared.add(std::to_string(triangles.count()) + " triangles have the edge " + place);
  }
  open.append_to(faults);
  shared.append_to(faults);
}

/// Which triangles face the same way: spread over edges that two triangles share.
class Orientation {
 public:
  Orientation(const TriangleMesh& mesh, const EdgeMap& edges) : side_(mesh.triangles.size(), 0) {
    std::vector<std::vector<Neighbor>> neighbors(mesh.triangles.size());
    for (const auto& [edge, triangles] : edges) {
      if (triangles.count() != 2) continue;
      const bool agree = triangles.along.size() == 1;
      const std::size_t a = triangles.along.empty() ? triangles.back[0] : triangles.along[0];
      const std::size_t b = triangles.back.empty() ? triangles.along[1] : triangles.back[agree ? 0 : 1];
      if (a == b) continue;  // degenerate
      neighbors[a].push_back({b, agree});
      neighbors[b].push_back({a, agree});
    }
    for (std::size_t t = 0; t < side_.size(); ++t)
      if (side_[t] == 0) spread(mesh, neighbors, t);
  }

  /// Triangles that face against the larger part of what they are joined to, in their order.
  [[nodiscard]] std::vector<std::size_t> inverted() const {
    std::vector<std::size_t> list = inverted_;
    std::sort(list.begin(), list.end());
    return list;
  }
  /// Whether no choice of sides could agree everywhere.
  [[nodiscard]] bool one_sided() const { return one_sided_; }

 private:
  struct Neighbor {
    std::size_t triangle;
    bool agrees;
  };

  void spread(const TriangleMesh& mesh, const std::vector<std::vector<Neighbor>>& neighbors, std::size_t start) {
    std::vector<std::size_t> part{start};
    side_[start] = 1;
    double area[2] = {0.0, 0.0};
    for (std::size_t next = 0; next < part.size(); ++next) {
      const std::size_t t = part[next];
      area[side_[t] == 1 ? 0 : 1] += mesh.area_vector(t).norm();
      for (const Neighbor& neighbor : neighbors[t]) {
        const int side = neighbor.agrees ? side_[t] : -side_[t];
        if (side_[neighbor.triangle] == 0) {
          side_[neighbor.triangle] = side;
          part.push_back(neighbor.triangle);
        } else if (side_[neighbor.triangle] != side) {
          one_sided_ = true;
        }
      }
    }
    const int minority = area[1] > area[0] ? 1 : -1;
    for (const std::size_t t : part)
      if (side_[t] == minority) inverted_.push_back(t);
  }

  std::vector<int> side_;  ///< 1 or -1; 0 not reached yet
  std::vector<std::size_t> inverted_;
  bool one_sided_ = false;
};

void check_orientation(const TriangleMesh& mesh, const EdgeMap& edges, const MeshOrigin& origin,
                       std::vector<std::string>& faults) {
  const Orientation orientation(mesh, edges);
  if (orientation.one_sided()) {
    faults.emplace_back(
        "the surface has a single side, as a Moebius strip: no choice of its triangles' order makes an "
        "inside and an outside");
    return;
  }
  FaultList inverted("inverted triangle");
  for (const std::size_t t : orientation.inverted())
    inverted.add(origin.describe(t) + " at " + text_of(mesh.corner(t, 0)) +
                 " faces against its neighbours; reverse the order of its corners");
  inverted.append_to(faults);
}

/// Each connected shell must enclose a positive volume.
void check_shells(const TriangleMesh& mesh, const MeshOrigin& origin, std::vector<std::string>& faults) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& triangle : mesh.triangles)
    for (std::size_t c = 1; c < 3; ++c) parent[root(triangle[c])] = root(triangle[0]);
  std::map<std::uint32_t, std::pair<double, std::size_t>> shells;  // volume, first triangle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& shell = shells.try_emplace(root(mesh.triangles[t][0]), 0.0, t).first->second;
    shell.first += (mesh.corner(t, 0) - mesh.vertices.front()).dot(mesh.area_vector(t)) / 3.0;
  }
  FaultList inwards("shell facing inwards");
  for (const auto& [vertex, shell] : shells)
    if (!(shell.first > 0.0)) {
      inwards.add("the one of " + origin.describe(shell.second) + " encloses " + std::to_string(shell.first) +
                  " m^3; reverse its triangles");
    }
  inwards.append_to(faults);
}

}  // namespace

std::vector<std::string> find_mesh_faults(const TriangleMesh& mesh, MeshKind kind, const MeshOrigin& origin) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) return {"the mesh has no triangles"};
  std::vector<std::string> faults;
  check_numbers(mesh, faults);
  if (!faults.empty()) return faults;
  check_areas(mesh, origin, faults);
  const EdgeMap edges = collect_edges(mesh);
  check_edges(mesh, edges, kind, origin, faults);
  check_orientation(mesh, edges, origin, faults);
  if (faults.empty() && kind == MeshKind::kClosed) check_shells(mesh, origin, faults);
  return faults;
}

}  // namespace pelagos
