#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <sstream>

#include "flat_triangles.hpp"
#include "mesh_edges.hpp"
#include "rigid/mesh_union.hpp"
#include "rigid/triangle_mesh.hpp"
#include "union_words.hpp"

namespace pelagos {

namespace {

constexpr double kFarthest = 1e6;      ///< m, of a coordinate
constexpr double kLeastVolume = 1e-9;  ///< of the size cubed: a part with less is looked at more closely

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

void check_numbers(const TriangleMesh& mesh, const MeshOrigin& origin, Refusals& faults) {
  FaultList absurd("corner out of range");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      if (vertex >= mesh.vertices.size()) {
        faults.push_back({"", "a triangle names vertex " + std::to_string(vertex) + " of none"});
        return;
      }
      const Eigen::Vector3d& corner = mesh.vertices[vertex];
      if (corner.allFinite() && corner.cwiseAbs().maxCoeff() <= kFarthest) continue;
      absurd.add([&] {
        return origin.describe(t) + " has a corner at " + text_of(corner) +
               "; allowed are finite coordinates up to 1e6 m. Move the mesh to its origin, or mend its scale";
      });
      break;
    }
  absurd.append_to(faults);
}

/// Whether two triangles are of one polygon of the file.
bool are_one_polygon(const MeshOrigin& origin, std::size_t a, std::size_t b) {
  return std::max(a, b) < origin.part.size() && origin.part[a] == origin.part[b] && origin.place[a] == origin.place[b];
}

void check_areas(const TriangleMesh& mesh, const MeshOrigin& origin, Refusals& faults) {
  const double least = kLeastArea * size_of(mesh).squaredNorm();
  FaultList degenerate("degenerate triangle");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!(mesh.area_vector(t).norm() > least))
      degenerate.add([&] {
        return origin.describe(t) + " at " + text_of(mesh.corner(t, 0)) + " has no area: its corners lie on one line";
      });
  degenerate.append_to(faults);
}

void check_edges(const TriangleMesh& mesh, std::span<const EdgeUse> uses, MeshKind kind, const MeshOrigin& origin,
                 Refusals& faults) {
  FaultList open("open edge"), shared("edge shared by too many triangles");
  const auto place_of = [&](const EdgeUse& use) {
    return "from " + text_of(mesh.vertices[use.low]) + " to " + text_of(mesh.vertices[use.high]);
  };
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 1 && kind == MeshKind::kClosed)
      open.add([&] { return "only " + origin.describe(edge[0].triangle) + " has the edge " + place_of(edge[0]); });
    if (edge.size() > 2 && 2 * count_along(edge) != edge.size())
      shared.add([&] {
        return std::to_string(edge.size()) + " triangles have the edge " + place_of(edge[0]) + ", one of them " +
               origin.describe(edge[0].triangle) +
               "; allowed: two, or where parts touch as many along it as back. Remove what is inside a part, as a "
               "bulkhead without thickness is, or make it a closed part of its own";
      });
  });
  open.append_to(faults);
  if (!open.empty())
    faults.push_back({"open edge",
                      "close the surface there. A mesh that is one side of something larger, as a sea bed is, may have "
                      "open edges where its body is STATIC and says open: true (pelagos-mesh --open)"});
  shared.append_to(faults);
}

/// Which triangles face the same way: spread over edges at which two triangles are joined.
class Orientation {
 public:
  Orientation(const TriangleMesh& mesh, std::span<const EdgePair> pairs) : side_(mesh.triangles.size(), 0) {
    const Neighbors neighbors(mesh.triangles.size(), pairs);
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
    std::uint32_t triangle;
    bool agrees;
  };

  /// What each triangle is joined to, in one list.
  class Neighbors {
   public:
    Neighbors(std::size_t triangles, std::span<const EdgePair> pairs) : first_(triangles + 1, 0) {
      for (const EdgePair& pair : pairs) ++first_[pair.a + 1], ++first_[pair.b + 1];
      std::partial_sum(first_.begin(), first_.end(), first_.begin());
      list_.resize(first_.back());
      std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
      for (const EdgePair& pair : pairs) {
        list_[next[pair.a]++] = {pair.b, pair.agree};
        list_[next[pair.b]++] = {pair.a, pair.agree};
      }
    }
    [[nodiscard]] std::span<const Neighbor> of(std::size_t triangle) const {
      return std::span(list_).subspan(first_[triangle], first_[triangle + 1] - first_[triangle]);
    }

   private:
    std::vector<std::uint32_t> first_;
    std::vector<Neighbor> list_;
  };

  void spread(const TriangleMesh& mesh, const Neighbors& neighbors, std::size_t start) {
    std::vector<std::size_t> part{start};
    side_[start] = 1;
    double area[2] = {0.0, 0.0};
    for (std::size_t next = 0; next < part.size(); ++next) {
      const std::size_t t = part[next];
      area[side_[t] == 1 ? 0 : 1] += mesh.area_vector(t).norm();
      for (const Neighbor& neighbor : neighbors.of(t)) {
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

void check_orientation(const TriangleMesh& mesh, std::span<const EdgePair> pairs, const MeshOrigin& origin,
                       Refusals& faults) {
  const Orientation orientation(mesh, pairs);
  if (orientation.one_sided()) {
    faults.push_back({"",
                      "the surface has a single side, as a Moebius strip: no choice of its triangles' order makes an "
                      "inside and an outside"});
    return;
  }
  FaultList inverted("inverted triangle");
  const std::vector<std::size_t> list = orientation.inverted();
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (n > 0 && are_one_polygon(origin, list[n - 1], list[n])) continue;
    inverted.add([&] {
      return origin.describe(list[n]) + " at " + text_of(mesh.corner(list[n], 0)) +
             " faces against its neighbours; reverse the order of its corners";
    });
  }
  inverted.append_to(faults);
}

/// Each part must enclose a volume: a positive one, unless it is a cavity of others.
void check_parts(const TriangleMesh& mesh, std::span<const EdgePair> pairs, const MeshOrigin& origin,
                 Refusals& faults) {
  const MeshShells shells = find_shells(mesh.triangles.size(), pairs);
  std::vector<double> volume(shells.first.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    volume[shells.of[t]] +=
        (mesh.corner(t, 0) - mesh.corner(shells.first[shells.of[t]], 0)).dot(mesh.area_vector(t)) / 3.0;
  const double least = kLeastVolume * std::pow(size_of(mesh).maxCoeff(), 3.0);
  if (std::any_of(volume.begin(), volume.end(), [&](double v) { return !(v > least); }))
    faults = unite_parts(mesh, origin).faults;
}

}  // namespace

Refusals find_mesh_faults(const TriangleMesh& mesh, MeshKind kind, const MeshOrigin& origin) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) return {{"", "the mesh has no triangles"}};
  Refusals faults;
  check_numbers(mesh, origin, faults);
  if (!faults.empty()) return faults;
  check_areas(mesh, origin, faults);
  const std::vector<EdgeUse> uses = collect_edges(mesh);
  check_edges(mesh, uses, kind, origin, faults);
  const std::vector<EdgePair> pairs = pair_triangles(mesh, uses);
  check_orientation(mesh, pairs, origin, faults);
  if (faults.empty() && kind == MeshKind::kClosed) check_parts(mesh, pairs, origin, faults);
  return faults;
}

}  // namespace pelagos
