#include "rigid/triangle_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <unordered_map>
#include <utility>

namespace pelagos {

namespace {

constexpr std::size_t kFaultsShown = 3;  ///< of each kind

/// Collects faults of one kind: the first few in words, the rest as a number.
class FaultList {
 public:
  explicit FaultList(std::string kind) : kind_(std::move(kind)) {}
  void add(const std::string& text) {
    if (++count_ <= kFaultsShown) shown_.push_back(kind_ + ": " + text);
  }
  void append_to(std::vector<std::string>& faults) const {
    faults.insert(faults.end(), shown_.begin(), shown_.end());
    if (count_ > kFaultsShown) faults.push_back(kind_ + ": " + std::to_string(count_ - kFaultsShown) + " more");
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
  Eigen::Vector3d low = mesh.vertices.front(), high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return high - low;
}

double signed_volume(const TriangleMesh& mesh, std::size_t t, const Eigen::Vector3d& reference) {
  const Eigen::Vector3d a = mesh.corner(t, 0) - reference, b = mesh.corner(t, 1) - reference;
  return a.dot(b.cross(mesh.corner(t, 2) - reference)) / 6.0;
}

/// Directed edge -> triangles that run along it.
using EdgeMap = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>>;

EdgeMap collect_edges(const TriangleMesh& mesh) {
  EdgeMap edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) edges[{mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3]}].push_back(t);
  return edges;
}

void check_edges(const TriangleMesh& mesh, const EdgeMap& edges, std::vector<std::string>& faults) {
  FaultList open("open edge"), inverted("inverted triangle"), shared("edge shared by too many triangles");
  for (const auto& [edge, along] : edges) {
    const auto [a, b] = edge;
    const auto back = edges.find({b, a});
    const std::size_t against = back == edges.end() ? 0 : back->second.size();
    const std::string place = "from " + text_of(mesh.vertices[a]) + " to " + text_of(mesh.vertices[b]);
    if (along.size() == 1 && against == 1) continue;
    if (against > 0 && a > b) continue;  // reported from the other side
    if (along.size() + against == 1) {
      open.add("only triangle " + std::to_string(along[0] + 1) + " has the edge " + place);
    } else if (along.size() + against == 2) {
      inverted.add("triangles " + std::to_string(along[0] + 1) + " and " + std::to_string(along[1] + 1) +
                   " run the same way along the edge " + place);
    } else {
      shared.add(std::to_string(along.size() + against) + " triangles have the edge " + place);
    }
  }
  open.append_to(faults);
  inverted.append_to(faults);
  shared.append_to(faults);
}

/// Each connected shell must enclose a positive volume.
void check_shells(const TriangleMesh& mesh, std::vector<std::string>& faults) {
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
    shell.first += signed_volume(mesh, t, mesh.vertices.front());
  }
  FaultList inwards("shell facing inwards");
  for (const auto& [vertex, shell] : shells)
    if (!(shell.first > 0.0)) {
      inwards.add("the one of triangle " + std::to_string(shell.second + 1) + " encloses " +
                  std::to_string(shell.first) + " m^3; reverse its triangles");
    }
  inwards.append_to(faults);
}

}  // namespace

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

std::vector<std::string> find_mesh_faults(const TriangleMesh& mesh) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) return {"the mesh has no triangles"};
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      if (vertex >= mesh.vertices.size()) return {"a triangle names vertex " + std::to_string(vertex) + " of none"};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite() || mesh.vertices[v].cwiseAbs().maxCoeff() > 1e6)
      return {"vertex " + std::to_string(v + 1) + " lies at " + text_of(mesh.vertices[v]) +
              ", allowed are finite coordinates up to 1e6 m"};

  std::vector<std::string> faults;
  const double size = size_of(mesh).norm();
  FaultList degenerate("degenerate triangle");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d along = mesh.corner(t, 1) - mesh.corner(t, 0);
    const double area = 0.5 * along.cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm();
    if (!(area > 1e-12 * size * size))
      degenerate.add("triangle " + std::to_string(t + 1) + " at " + text_of(mesh.corner(t, 0)) + " has no area");
  }
  degenerate.append_to(faults);
  check_edges(mesh, collect_edges(mesh), faults);
  if (faults.empty()) check_shells(mesh, faults);
  return faults;
}

double mesh_volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) volume += signed_volume(mesh, t, mesh.vertices.front());
  return volume;
}

double mesh_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d along = mesh.corner(t, 1) - mesh.corner(t, 0);
    area += 0.5 * along.cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm();
  }
  return area;
}

}  // namespace pelagos
