#include "body_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "rigid/body_mass.hpp"

namespace pelagos {

namespace {

constexpr double kTouching = 0.1;  ///< spacings that a free body may overlap a wall by at the start

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string describe(const Eigen::Vector3d& v) {
  return "(" + digits(v.x()) + ", " + digits(v.y()) + ", " + digits(v.z()) + ")";
}

/// The patch and, beyond open edges, the sea around it.
Box sea_of(const Scene& scene) {
  constexpr double kFar = 1e9;
  Box sea = scene.patch;
  for (int axis = 0; axis < 2; ++axis)
    if (scene.patch_edges[static_cast<std::size_t>(axis)] == PatchEdge::kOpen)
      sea.min[axis] = -kFar, sea.max[axis] = kFar;
  return sea;
}

void check_in_patch(const Scene& scene, double support_radius, const PlacedShape& body, Refusals& faults) {
  const auto& samples = body.shape->samples;
  const Box water = body.settings->drive == BodyDrive::kStatic ? scene.patch : sea_of(scene);
  const bool reached = std::any_of(samples.begin(), samples.end(), [&](const Eigen::Vector3f& sample) {
    return is_within_reach(water, body.to_world(sample.cast<double>()), support_radius);
  });
  if (reached) return;
  const Eigen::AlignedBox3d place = body.place();
  faults.push_back({"", "its surface lies outside the patch, at " + describe(place.min()) + " to " +
                            describe(place.max()) + " m; allowed: some of it within " + describe(scene.patch.min) +
                            " to " + describe(scene.patch.max)});
}

/// m, between a body and the nearer face of the patch across an axis; negative: it reaches beyond.
double room_across(const Scene& scene, const Eigen::AlignedBox3d& place, int axis) {
  return std::min(place.min()[axis] - scene.patch.min[axis], scene.patch.max[axis] - place.max()[axis]);
}

/// A free body that stood in a wall would be pushed out of it with a bang.
void check_walls(const Scene& scene, const PlacedShape& body, Refusals& faults) {
  if (body.settings->drive != BodyDrive::kFree) return;
  const Eigen::AlignedBox3d place = body.place();
  for (int axis = 0; axis < 3; ++axis) {
    const PatchEdge edge = scene.patch_edges[static_cast<std::size_t>(axis)];
    if (edge == PatchEdge::kPeriodic || edge == PatchEdge::kOpen) continue;
    const double room = room_across(scene, place, axis);
    if (room >= -kTouching * scene.particle_spacing) continue;
    faults.push_back({"", "stands in a wall of the tank: it reaches " + digits(-room) + " m beyond the face across " +
                              std::string(1, "xyz"[axis]) + "; allowed for a FREE body: all of it inside the patch, " +
                              describe(scene.patch.min) + " to " + describe(scene.patch.max)});
    return;
  }
}

/// A body has no image beyond periodic faces.
void check_faces(const Scene& scene, double support_radius, const PlacedShape& body, Refusals& faults) {
  const Eigen::AlignedBox3d place = body.place();
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.patch_edges[static_cast<std::size_t>(axis)] != PatchEdge::kPeriodic) continue;
    const double room = room_across(scene, place, axis);
    if (room >= support_radius) continue;
    faults.push_back({"", "reaches to " + digits(room) + " m from a periodic face across " +
                              std::string(1, "xyz"[axis]) + "; allowed: at least a support radius, " +
                              digits(support_radius) + " m, since it has no image beyond"});
    return;
  }
}

/// Whether water that starts in a block could stand at a point off the patch's faces.
bool stands_in_water(const Scene& scene, const Eigen::Vector3d& x) {
  const double margin = 1.5 * scene.particle_spacing;  // so near to a face no particle fits past a rim
  const auto within = [&](const Box& box, double by) {
    return (x.array() > box.min.array() + by).all() && (x.array() < box.max.array() - by).all();
  };
  return within(scene.patch, margin) && std::any_of(scene.water.blocks.begin(), scene.water.blocks.end(),
                                                    [&](const Box& block) { return within(block, 0.0); });
}

/// Water would run behind an open mesh where its rim stands in it.
void check_rim(const Scene& scene, const PlacedShape& body, Refusals& faults) {
  for (const auto& [from, to] : body.shape->rim) {
    const Eigen::Vector3d a = body.to_world(from), b = body.to_world(to);
    const double parts = std::ceil((b - a).norm() / scene.particle_spacing);
    for (double part = 0.0; part <= parts; part += 1.0) {
      const Eigen::Vector3d x = a + part / parts * (b - a);
      if (!stands_in_water(scene, x)) continue;
      faults.push_back(
          {"", "the rim of its open mesh stands in water at " + describe(x) +
                   " m, which would run behind it; allowed: rims at the patch's faces or above the water"});
      return;
    }
  }
}

/// Mean densities beyond these shares of the water's are not known to be stable.
constexpr double kLightest = 0.02, kHeaviest = 20.0;

void check_mass(const Scene& scene, const PlacedShape& body, Refusals& faults) {
  const MassSettings& settings = body.settings->mass;
  if (!is_free(body.settings->drive)) return;
  const MassProperties& solid = body.shape->solid;
  const double share = body_mass(settings, solid).mass / body.shape->displacement / scene.water.rest_density;
  if (!(share >= kLightest && share <= kHeaviest))
    faults.push_back({"", "its mean density is " + digits(share) +
                              " times that of the water; allowed: " + digits(kLightest) + " to " + digits(kHeaviest) +
                              " (its mesh encloses " + digits(body.shape->displacement) + " m^3)"});
  if (settings.centre && !body.shape->bounding_box.contains(*settings.centre))
    faults.push_back({"", "its centre of mass " + describe(*settings.centre) + " m lies outside its mesh, " +
                              describe(body.shape->bounding_box.min()) + " to " +
                              describe(body.shape->bounding_box.max())});
}

/// How many samples of a body are inside the other.
std::size_t samples_inside(const PlacedShape& body, const PlacedShape& other) {
  if (other.shape->kind == MeshKind::kClosed && !body.place().intersects(other.place())) return 0;
  const auto& samples = body.shape->samples;
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [&](const Eigen::Vector3f& sample) {
    const Eigen::Vector3d world = body.to_world(sample.cast<double>());
    return other.shape->inside(other.to_body(world));
  }));
}

void check_overlap(const PlacedShape& body, const PlacedShape& other, Refusals& faults) {
  const std::size_t inside = samples_inside(body, other), all = body.shape->samples.size();
  const bool both_static = body.settings->drive == BodyDrive::kStatic && other.settings->drive == BodyDrive::kStatic;
  if (inside == 0 || (both_static && inside < all)) return;
  faults.push_back(
      {"", "stands in " + other.name() + ": " + std::to_string(inside) + " of its " + std::to_string(all) +
               " boundary samples are inside it; allowed: " +
               (both_static ? "static bodies that stand in one another in part" : "bodies apart at the start")});
}

}  // namespace

bool is_within_reach(const Box& patch, const Eigen::Vector3d& world, double support_radius) {
  return (world.array() >= patch.min.array() - support_radius).all() &&
         (world.array() <= patch.max.array() + support_radius).all();
}

Refusals body_faults(const Scene& scene, double support_radius, std::span<const PlacedShape> bodies) {
  Refusals all;
  for (const PlacedShape& body : bodies) {
    Refusals faults = body.shape->faults;  // of the mesh
    if (faults.empty()) {
      check_mass(scene, body, faults);
      check_in_patch(scene, support_radius, body, faults);
      check_walls(scene, body, faults);
      check_faces(scene, support_radius, body, faults);
      check_rim(scene, body, faults);
      for (const PlacedShape& other : bodies)
        if (other.settings != body.settings && other.shape->faults.empty()) check_overlap(body, other, faults);
    }
    for (const Refusal& fault : faults) all.push_back(put_behind(body.name(), ": ", fault));
  }
  return all;
}

}  // namespace pelagos
