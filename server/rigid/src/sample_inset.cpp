#include "rigid/sample_inset.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh_edges.hpp"
#include "scales/angles.hpp"

namespace pelagos {

namespace {

constexpr double kFlatFaces = 0.53, kCurvedFaces = 0.61;   ///< spacings
constexpr double kFlatShare = 0.9;                         ///< of the area
constexpr double kLeastTurn = kRadiansPerDegree;           ///< between faces of a curved surface
constexpr double kLargestTurn = 40.0 * kRadiansPerDegree;  ///< more is an edge between two flat ones

bool is_part_of_curve(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double turn = std::atan2(a.cross(b).norm(), a.dot(b));
  return turn > kLeastTurn && turn < kLargestTurn;
}

}  // namespace

double default_sample_inset(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> curved(mesh.triangles.size(), 0);
  const std::vector<EdgeUse> uses = collect_edges(mesh);
  for (const EdgePair& pair : pair_triangles(mesh, uses))
    if (is_part_of_curve(mesh.area_vector(pair.a), mesh.area_vector(pair.b))) curved[pair.a] = curved[pair.b] = 1;
  double flat = 0.0, all = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = mesh.area_vector(t).norm();
    all += area;
    if (curved[t] == 0) flat += area;
  }
  return flat >= kFlatShare * all ? kFlatFaces : kCurvedFaces;
}

}  // namespace pelagos
