#include "rigid/convex_hull.hpp"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

namespace {

double hull_volume(const TriangleMesh& mesh) {
  btConvexHullComputer hull;
  hull.compute(mesh.vertices.front().data(), sizeof(Eigen::Vector3d), static_cast<int>(mesh.vertices.size()), 0.0, 0.0);
  const auto corner = [&](int vertex) {
    const btVector3& v = hull.vertices[vertex];
    return Eigen::Vector3d(v.x(), v.y(), v.z());
  };
  double volume = 0.0;
  const Eigen::Vector3d apex = corner(0);
  for (int k = 0; k < hull.faces.size(); ++k) {
    const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[k]];
    const Eigen::Vector3d a = corner(first->getSourceVertex()) - apex;
    for (const auto* edge = first->getNextEdgeOfFace(); edge != first; edge = edge->getNextEdgeOfFace())
      volume += a.dot((corner(edge->getSourceVertex()) - apex).cross(corner(edge->getTargetVertex()) - apex)) / 6.0;
  }
  return std::abs(volume);
}

}  // namespace

double hollow_share(const TriangleMesh& mesh) {
  if (mesh.vertices.size() < 4) return 0.0;
  const double hull = hull_volume(mesh);
  return hull > 0.0 ? std::clamp(1.0 - mesh_volume(mesh) / hull, 0.0, 1.0) : 0.0;
}

}  // namespace pelagos
