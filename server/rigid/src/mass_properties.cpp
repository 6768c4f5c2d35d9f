#include "rigid/mass_properties.hpp"

namespace pelagos {

MassProperties mass_properties(const TriangleMesh& mesh) {
  MassProperties properties;
  if (mesh.triangles.empty()) return properties;
  const Eigen::Vector3d reference = mesh.corner(0, 0);  // near the body, so that no digits are lost far from the origin
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0) - reference, b = mesh.corner(t, 1) - reference,
                          c = mesh.corner(t, 2) - reference, sum = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6.0;
    properties.volume += volume;
    moment += volume / 4.0 * sum;
    second += volume / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const Eigen::Vector3d offset = moment / properties.volume;
  second -= properties.volume * offset * offset.transpose();
  properties.centre = reference + offset;
  properties.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return properties;
}

}  // namespace pelagos
