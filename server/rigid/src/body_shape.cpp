#include "rigid/body_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "poisson_disk.hpp"
#include "rigid/mesh_union.hpp"
#include "rigid/sample_inset.hpp"

namespace pelagos {

namespace {

constexpr double kCandidateSpacing = 0.25;  ///< of the particle spacing
constexpr double kLeastDistance = 0.8;      ///< between samples, in spacings: one sample per spacing^2 on a plane
constexpr std::size_t kMostCandidates = 8'000'000;
constexpr double kDistanceSlack = 0.98;  ///< a candidate nearer to the surface than this part of its inset is dropped

/// A triangle standing on its longest edge: base from `left` to `right`, apex above. Long thin triangles, which hulls
/// are full of, so get as many points as their area asks for.
struct StandingTriangle {
  Eigen::Vector3d left, right, apex;
  double base = 0.0;
  int rows = 1;

  StandingTriangle(const TriangleMesh& mesh, std::size_t t, double step) {
    std::size_t longest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      if (const double length = (mesh.corner(t, (c + 1) % 3) - mesh.corner(t, c)).norm(); length > base) {
        base = length;
        longest = c;
      }
    left = mesh.corner(t, longest);
    right = mesh.corner(t, (longest + 1) % 3);
    apex = mesh.corner(t, (longest + 2) % 3);
    const double height = (right - left).cross(apex - left).norm() / base;
    rows = static_cast<int>(std::min(std::ceil(height / step), 1e6));
    rows = std::max(rows, 1);
  }
};

/// Calls visit(point, inward normal, is_corner) for points spread over the surface: in rows over each triangle, corners
/// and edges included; then each corner with the average of its normals, so that reentrant edges are covered as well.
template <class Visit>
void for_each_surface_point(const TriangleMesh& mesh, double step, Visit&& visit) {
  std::vector<Eigen::Vector3d> corner_normal(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const StandingTriangle triangle(mesh, t, step);
    const Eigen::Vector3d normal = (triangle.right - triangle.left).cross(triangle.apex - triangle.left).normalized();
    for (const std::uint32_t v : mesh.triangles[t]) corner_normal[v] += normal;
    for (int row = 0; row <= triangle.rows; ++row) {
      const double up = static_cast<double>(row) / triangle.rows;
      const Eigen::Vector3d start = triangle.left + up * (triangle.apex - triangle.left);
      const Eigen::Vector3d way = (1.0 - up) * (triangle.right - triangle.left);
      const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
      for (int part = 0; part <= parts; ++part)
        visit(Eigen::Vector3d(start + way * (static_cast<double>(part) / parts)), Eigen::Vector3d(-normal), false);
    }
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (corner_normal[v].norm() > 1e-9) visit(mesh.vertices[v], Eigen::Vector3d(-corner_normal[v].normalized()), true);
}

/// How many points for_each_surface_point will visit, at most.
double count_surface_points(const TriangleMesh& mesh, double step) {
  double count = static_cast<double>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const StandingTriangle triangle(mesh, t, step);
    count += (triangle.rows + 1.0) * (0.5 * triangle.base / step + 2.0);
  }
  return count;
}

struct Candidates {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> inward;  ///< unit, from the surface; zero in the middle of a plate and on the surface
};

/// Points `inset` below the surface, or in the middle where the body is thinner than twice that.
Candidates make_candidates(const TriangleMesh& mesh, const BodyShape& shape, double step, double inset) {
  const MeshQuery& surface = *shape.surface;
  const double tiny = 1e-9 * surface.bounding_box().sizes().maxCoeff();
  Candidates candidates;
  const auto add = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& inward) {
    candidates.points.push_back(point);
    candidates.inward.push_back(inward);
  };
  for_each_surface_point(mesh, step, [&](const Eigen::Vector3d& point, const Eigen::Vector3d& inward, bool is_corner) {
    if (inset <= 0.0) {
      add(point, Eigen::Vector3d::Zero());
      return;
    }
    const double thickness = surface.first_hit(point, inward, tiny);
    if (!std::isfinite(thickness) && shape.kind == MeshKind::kClosed)
      return;  // an averaged normal may point out of a thin corner
    const double depth = std::min(inset, 0.5 * thickness);
    const Eigen::Vector3d candidate = point + depth * inward;
    if (depth <= tiny || surface.distance(candidate, inset) < kDistanceSlack * depth) return;
    // Before its first meeting with the surface a ray from a face inwards is inside; an average may point outwards.
    if (is_corner && !shape.inside(candidate)) return;
    add(candidate, depth < inset ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : inward);
  });
  return candidates;
}

/// The surface that the water meets: of a closed mesh the boundary of what its parts make together, of an open one the
/// mesh, with its rim.
void take_surface(const TriangleMesh& mesh, const MeshOrigin& origin, BodyShape& shape) {
  if (shape.kind == MeshKind::kOpen) {
    shape.mesh = mesh;
    for (const auto& [from, to] : rim_edges(mesh)) shape.rim.push_back({mesh.vertices[from], mesh.vertices[to]});
    return;
  }
  MeshUnion united = unite_parts(mesh, origin);
  shape.notes = std::move(united.notes);
  shape.faults = std::move(united.faults);
  if (!shape.faults.empty()) return;
  shape.solid = mass_properties(united.mesh);
  shape.mesh = united.outer ? std::move(*united.outer) : std::move(united.mesh);
  shape.displacement = mesh_volume(shape.mesh);
}

}  // namespace

double BodyShape::signed_distance(const Eigen::Vector3d& point_body, double limit) const {
  const double distance = surface->distance(point_body, limit);
  return inside(point_body) ? -distance : distance;
}

BodyShape make_body_shape(const TriangleMesh& given, double spacing, std::optional<double> inset, MeshKind kind,
                          const MeshOrigin& origin) {
  BodyShape shape;
  shape.kind = kind;
  shape.faults = find_mesh_faults(given, kind, origin);
  if (shape.faults.empty()) take_surface(given, origin, shape);
  const TriangleMesh& mesh = shape.mesh;
  const double step = kCandidateSpacing * spacing;
  if (shape.faults.empty() && !(count_surface_points(mesh, step) <= static_cast<double>(kMostCandidates)))
    shape.faults.push_back({"", "the surface of " + std::to_string(mesh_area(mesh)) +
                                    " m^2 is too large to sample at " + std::to_string(spacing) +
                                    " m: raise particle_spacing or mend mesh_scale"});
  if (!shape.faults.empty()) return shape;

  shape.inset = inset.value_or(default_sample_inset(mesh));
  shape.surface = std::make_shared<const MeshQuery>(mesh);
  for (const Eigen::Vector3d& vertex : mesh.vertices) shape.bounding_box.extend(vertex);

  const Candidates candidates = make_candidates(mesh, shape, step, shape.inset * spacing);
  for (const std::size_t chosen : select_poisson_disk(candidates.points, candidates.inward, kLeastDistance * spacing)) {
    shape.samples.push_back(candidates.points[chosen].cast<float>());
    shape.inward.push_back(candidates.inward[chosen].cast<float>());
    shape.reach = std::max(shape.reach, candidates.points[chosen].norm());
  }
  if (shape.samples.empty())
    shape.faults.push_back({"", "no place for boundary samples: the body is too small or too thin"});
  return shape;
}

BodyShape load_body_shape(const std::string& path, const MeshOptions& options, double spacing,
                          std::optional<double> inset) {
  MeshFile file = read_mesh(path, options);
  BodyShape shape;
  if (!file.faults.empty()) {
    shape.faults = std::move(file.faults);
    return shape;
  }
  shape = make_body_shape(file.mesh, spacing, inset, options.kind, file.origin);
  shape.notes.insert(shape.notes.begin(), file.notes.begin(), file.notes.end());
  for (Refusal& fault : shape.faults) fault = put_behind(path, ": ", fault);
  for (std::string& note : shape.notes) note.insert(0, path + ": ");
  return shape;
}

void place_samples(const BodyShape& shape, const BodyState& state, const PatchFrame& patch, std::span<Float4> position,
                   std::span<Float4> velocity) {
  assert(position.size() >= shape.samples.size() && velocity.size() >= shape.samples.size());
  const Eigen::Matrix3d rotation = state.orientation.toRotationMatrix();
  const Eigen::Vector3d centre = patch.to_local(state.position);
  for (std::size_t n = 0; n < shape.samples.size(); ++n) {
    const Eigen::Vector3d arm = rotation * shape.samples[n].cast<double>();
    const Eigen::Vector3f place = (centre + arm).cast<float>();
    const Eigen::Vector3f speed = (state.velocity + state.angular_velocity.cross(arm)).cast<float>();
    position[n].x = place.x(), position[n].y = place.y(), position[n].z = place.z();
    velocity[n].x = speed.x(), velocity[n].y = speed.y(), velocity[n].z = speed.z();
  }
}

}  // namespace pelagos
