#include "rigid/hydrostatics.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

namespace pelagos {

namespace {

constexpr double kNoWaterplane = 1e-12;  ///< of the wetted area: what rounding leaves of a submerged body's lid

/// A triangle's part below the plane: nothing, a triangle, or a quadrangle.
struct WetPolygon {
  std::array<Eigen::Vector3d, 4> corner;
  std::size_t count = 0;
  void add(const Eigen::Vector3d& point) { corner[count++] = point; }
};

/// Clips a triangle with the plane through the origin (Sutherland and Hodgman 1974, for one plane).
WetPolygon clip(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& up) {
  WetPolygon wet;
  for (std::size_t c = 0; c < 3; ++c) {
    const Eigen::Vector3d &from = triangle[c], &to = triangle[(c + 1) % 3];
    const double a = up.dot(from), b = up.dot(to);
    if (a < 0.0) wet.add(from);
    if ((a < 0.0) != (b < 0.0)) wet.add(from + a / (a - b) * (to - from));
  }
  return wet;
}

/// int x x^T over a triangle or tetrahedron with a corner at the origin is this, times its size, over 12 or 20.
Eigen::Matrix3d corner_products(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d sum = a + b + c;
  return a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose();
}

/// Sums relative to a point in the plane.
struct Sums {
  double volume = 0.0, wetted = 0.0, waterplane = 0.0;
  Eigen::Vector3d volume_moment = Eigen::Vector3d::Zero(), waterplane_moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d waterplane_second = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& up) {
    const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
    const double tetrahedron = a.dot(area) / 3.0;
    volume += tetrahedron;
    volume_moment += tetrahedron / 4.0 * (a + b + c);
    wetted += area.norm();
    const auto project = [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(x - up.dot(x) * up); };
    const Eigen::Vector3d pa = project(a), pb = project(b), pc = project(c);
    const double lid = -area.dot(up);
    waterplane += lid;
    waterplane_moment += lid / 3.0 * (pa + pb + pc);
    waterplane_second += lid / 12.0 * corner_products(pa, pb, pc);
  }
};

}  // namespace

Hydrostatics hydrostatics(const TriangleMesh& mesh, const WaterPlane& water) {
  Hydrostatics result;
  if (mesh.triangles.empty()) return result;
  // The point of the plane nearest to the mesh's first vertex: digits are kept far from the origin.
  const Eigen::Vector3d first = mesh.corner(0, 0);
  const Eigen::Vector3d reference = first + (water.level - water.up.dot(first)) * water.up;
  Sums sums;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const WetPolygon wet =
        clip({mesh.corner(t, 0) - reference, mesh.corner(t, 1) - reference, mesh.corner(t, 2) - reference}, water.up);
    for (std::size_t k = 2; k < wet.count; ++k) sums.add(wet.corner[0], wet.corner[k - 1], wet.corner[k], water.up);
  }
  result.volume = sums.volume;
  result.wetted_area = sums.wetted;
  if (sums.volume > 0.0) result.centre_of_buoyancy = reference + sums.volume_moment / sums.volume;
  if (sums.waterplane > kNoWaterplane * sums.wetted) {
    result.waterplane_area = sums.waterplane;
    const Eigen::Vector3d centre = sums.waterplane_moment / sums.waterplane;
    result.centre_of_flotation = reference + centre;
    result.waterplane_moments = sums.waterplane_second - sums.waterplane * centre * centre.transpose();
  }
  return result;
}

}  // namespace pelagos
