#include "rigid/body_shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "farthest_points.hpp"

namespace pelagos {

namespace {

constexpr double kCandidateSpacing = 0.25;  ///< of the particle spacing
constexpr double kLeastDistance = 0.82;     ///< between samples, in spacings: one sample per spacing^2 on a plane
constexpr std::size_t kMostCandidates = 8'000'000;
constexpr double kDistanceSlack = 0.98;  ///< a candidate nearer to the surface than this part of its inset is dropped

/// Calls visit(point, inward normal) for points spread over the surface: on a triangular grid in each triangle, corners
/// and edges included. Normals at corners and edges are averages, so that reentrant edges are covered as well.
template <class Visit>
void for_each_surface_point(const TriangleMesh& mesh, double step, Visit&& visit) {
  const auto normal_of = [&](std::size_t t) {
    const Eigen::Vector3d along = mesh.corner(t, 1) - mesh.corner(t, 0);
    return Eigen::Vector3d(along.cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized());
  };
  std::vector<Eigen::Vector3d> corner_normal(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) corner_normal[v] += normal_of(t);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0), ab = mesh.corner(t, 1) - a, ac = mesh.corner(t, 2) - a;
    const Eigen::Vector3d normal = normal_of(t);
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const int parts = std::max(1, static_cast<int>(std::ceil(longest / step)));
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        visit(Eigen::Vector3d(a + ab * (static_cast<double>(i) / parts) + ac * (static_cast<double>(j) / parts)),
              Eigen::Vector3d(-normal));
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (corner_normal[v].norm() > 1e-9) visit(mesh.vertices[v], Eigen::Vector3d(-corner_normal[v].normalized()));
}

/// How many points for_each_surface_point will visit.
double count_surface_points(const TriangleMesh& mesh, double step) {
  double count = static_cast<double>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0), ab = mesh.corner(t, 1) - a, ac = mesh.corner(t, 2) - a;
    const double parts = std::max(1.0, std::ceil(std::max({ab.norm(), ac.norm(), (ac - ab).norm()}) / step));
    count += 0.5 * (parts + 1.0) * (parts + 2.0);
  }
  return count;
}

/// Points `inset` below the surface, or in the middle where the body is thinner than twice that.
std::vector<Eigen::Vector3d> make_candidates(const TriangleMesh& mesh, const MeshQuery& surface, double step,
                                             double inset) {
  const double tiny = 1e-9 * surface.bounding_box().sizes().maxCoeff();
  std::vector<Eigen::Vector3d> candidates;
  for_each_surface_point(mesh, step, [&](const Eigen::Vector3d& point, const Eigen::Vector3d& inward) {
    if (inset <= 0.0) {
      candidates.push_back(point);
      return;
    }
    const double thickness = surface.first_hit(point, inward, tiny);
    if (!std::isfinite(thickness)) return;  // an averaged normal may point out of a thin corner
    const double depth = std::min(inset, 0.5 * thickness);
    const Eigen::Vector3d candidate = point + depth * inward;
    if (depth > tiny && surface.distance(candidate, inset) >= kDistanceSlack * depth && surface.inside(candidate))
      candidates.push_back(candidate);
  });
  return candidates;
}

}  // namespace

double BodyShape::signed_distance(const Eigen::Vector3d& point_body, double limit) const {
  const double distance = surface->distance(point_body, limit);
  return surface->inside(point_body) ? -distance : distance;
}

BodyShape make_body_shape(const TriangleMesh& mesh, double spacing, double inset) {
  BodyShape shape;
  shape.faults = find_mesh_faults(mesh);
  const double step = kCandidateSpacing * spacing;
  if (shape.faults.empty() && !(count_surface_points(mesh, step) <= static_cast<double>(kMostCandidates)))
    shape.faults.push_back("the surface of " + std::to_string(mesh_area(mesh)) + " m^2 is too large to sample at " +
                           std::to_string(spacing) + " m: raise particle_spacing or mend mesh_scale");
  if (!shape.faults.empty()) return shape;

  shape.volume = mesh_volume(mesh);
  shape.surface = std::make_shared<const MeshQuery>(mesh);
  for (const Eigen::Vector3d& vertex : mesh.vertices) shape.bounding_box.extend(vertex);

  const auto candidates = make_candidates(mesh, *shape.surface, step, inset * spacing);
  for (const std::size_t chosen : select_farthest_points(candidates, kLeastDistance * spacing)) {
    shape.samples.push_back(candidates[chosen].cast<float>());
    shape.reach = std::max(shape.reach, candidates[chosen].norm());
  }
  if (shape.samples.empty()) shape.faults.push_back("no place for boundary samples: the body is too small or too thin");
  return shape;
}

BodyShape load_body_shape(const std::string& path, double scale, double spacing, double inset) {
  MeshFile file = read_mesh(path, scale);
  if (file.faults.empty()) return make_body_shape(file.mesh, spacing, inset);
  BodyShape shape;
  shape.faults = std::move(file.faults);
  return shape;
}

void place_samples(const BodyShape& shape, const BodyState& state, const Eigen::Vector3d& origin,
                   std::span<Float4> position, std::span<Float4> velocity) {
  assert(position.size() >= shape.samples.size() && velocity.size() >= shape.samples.size());
  const Eigen::Matrix3d rotation = state.orientation.toRotationMatrix();
  const Eigen::Vector3d centre = state.position - origin;
  for (std::size_t n = 0; n < shape.samples.size(); ++n) {
    const Eigen::Vector3d arm = rotation * shape.samples[n].cast<double>();
    const Eigen::Vector3f place = (centre + arm).cast<float>();
    const Eigen::Vector3f speed = (state.velocity + state.angular_velocity.cross(arm)).cast<float>();
    position[n].x = place.x(), position[n].y = place.y(), position[n].z = place.z();
    velocity[n].x = speed.x(), velocity[n].y = speed.y(), velocity[n].z = speed.z();
  }
}

}  // namespace pelagos
