#include "rigid/sea_panels.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "rigid/mass_properties.hpp"
#include "rigid/triangle_mesh.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kMostTriangles = 2000;  ///< of a mesh that is taken as it is, but for its long edges
constexpr double kPanels = 300.0;             ///< squares of one edge's length on the surface
constexpr double kLongest = 1.5;              ///< edges
constexpr int kDeepest = 12;                  ///< halvings of one triangle

using Triangle = std::array<std::uint32_t, 3>;
using Cell = std::array<long, 3>;

/// Each vertex to the mean of those in its cell; triangles that vanish by that are left out.
TriangleMesh cluster(const TriangleMesh& mesh, double cell) {
  std::map<Cell, std::uint32_t> number;
  std::vector<std::uint32_t> cluster_of;
  std::vector<double> count;
  TriangleMesh coarse;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Cell at{std::lround(vertex.x() / cell), std::lround(vertex.y() / cell), std::lround(vertex.z() / cell)};
    const auto found = number.emplace(at, static_cast<std::uint32_t>(coarse.vertices.size()));
    if (found.second) {
      coarse.vertices.emplace_back(0.0, 0.0, 0.0);
      count.push_back(0.0);
    }
    const std::uint32_t k = found.first->second;
    coarse.vertices[k] += vertex;
    count[k] += 1.0;
    cluster_of.push_back(k);
  }
  for (std::size_t k = 0; k < count.size(); ++k) coarse.vertices[k] /= count[k];
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle t{cluster_of[triangle[0]], cluster_of[triangle[1]], cluster_of[triangle[2]]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) coarse.triangles.push_back(t);
  }
  return coarse;
}

/// Halves long edges. Both triangles of an edge halve it alike, at its middle.
class EdgeHalver {
 public:
  EdgeHalver(const TriangleMesh& mesh, double longest) : mesh_{mesh.vertices, {}}, longest_(longest) {
    for (const Triangle& triangle : mesh.triangles) add(triangle, 0);
  }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  void add(const Triangle& t, int depth) {
    std::size_t longest = 0;
    double length = -1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double edge = (mesh_.vertices[t[(c + 1) % 3]] - mesh_.vertices[t[c]]).norm();
      if (edge > length) length = edge, longest = c;
    }
    if (length <= longest_ || depth == kDeepest) {
      mesh_.triangles.push_back(t);
      return;
    }
    const std::uint32_t a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3], m = middle(a, b);
    add({a, m, c}, depth + 1);
    add({m, b, c}, depth + 1);
  }
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto found = middles_.emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (found.second) mesh_.vertices.emplace_back(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]));
    return found.first->second;
  }

  TriangleMesh mesh_;
  double longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

void scale_to(double volume, TriangleMesh& mesh) {
  const MassProperties solid = mass_properties(mesh);
  if (!(solid.volume > 0.0)) return;
  const double scale = std::cbrt(volume / solid.volume);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = solid.centre + scale * (vertex - solid.centre);
}

}  // namespace

SeaPanels make_sea_panels(const TriangleMesh& mesh) {
  SeaPanels panels;
  panels.edge = std::sqrt(mesh_area(mesh) / kPanels);
  const bool fine = mesh.triangles.size() > kMostTriangles;
  panels.mesh = EdgeHalver(fine ? cluster(mesh, 0.7 * panels.edge) : mesh, kLongest * panels.edge).take();
  if (fine) scale_to(mesh_volume(mesh), panels.mesh);
  return panels;
}

}  // namespace pelagos
