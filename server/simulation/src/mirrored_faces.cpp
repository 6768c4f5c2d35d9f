#include "mirrored_faces.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include <fmt/format.h>

namespace pelagos {

namespace {

constexpr double kLeastDistance = 0.8;  ///< spacings between samples
constexpr double kAtFace = 0.02;        ///< spacings: a smaller gap is none
constexpr double kCloseBy = 2.0;        ///< spacings: what holds the water at a place lies no farther along the face
constexpr double kLookBeyond = 4.0;     ///< spacings past a face: samples farther out say nothing of the place at it

/// One face of the patch.
struct Face {
  int axis = 0;
  bool upper = false;
  double place = 0.0;  ///< m, along the axis

  /// m, into the patch.
  [[nodiscard]] double distance(const Eigen::Vector3d& x) const { return upper ? place - x[axis] : x[axis] - place; }
};

/// A boundary sample near a face.
struct NearSample {
  Eigen::Vector3d place;  ///< m, world
  double distance = 0.0;  ///< m, into the patch
  double reach = 0.0;     ///< m, how far the body's surface reaches past the face here; negative: it ends before
};

bool is_at_water(const Scene& scene, const Face& face, double level, const Eigen::Vector3d& x) {
  if (x.z() > level + scene.particle_spacing) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != face.axis && (x[axis] < scene.patch.min[axis] || x[axis] > scene.patch.max[axis])) return false;
  return true;
}

std::vector<NearSample> samples_near(const Scene& scene, const Face& face, double level, double within,
                                     const PlacedShape& body) {
  const double d = scene.particle_spacing;
  const Eigen::AlignedBox3d place = body.place();
  const double of_box = -face.distance(face.upper ? place.max() : place.min());
  std::vector<NearSample> near;
  for (const Eigen::Vector3f& sample : body.shape->samples) {
    const Eigen::Vector3d at = sample.cast<double>(), x = body.to_world(at);
    const double distance = face.distance(x);
    if (distance > within + d || distance < -kLookBeyond * d || !is_at_water(scene, face, level, x)) continue;
    const double depth = body.shape->surface->distance(at, d);
    if (distance - depth >= within) continue;
    // Samples tell the reach short by the gaps between them; the box around the body tells that of its end.
    const double reach = depth - distance;
    near.push_back({x, distance, of_box - reach < kLeastDistance * d ? of_box : reach});
  }
  return near;
}

bool is_held(const NearSample& sample, std::span<const NearSample> beyond, double d) {
  const double radius = std::max(sample.distance, 0.0) + kCloseBy * d;
  return std::any_of(beyond.begin(), beyond.end(), [&](const NearSample& other) {
    return (other.place - sample.place).squaredNorm() <= radius * radius;
  });
}

bool is_buried(const PlacedShape& body, std::span<const PlacedShape> bodies, const Eigen::Vector3d& x) {
  return std::any_of(bodies.begin(), bodies.end(), [&](const PlacedShape& other) {
    return other.settings != body.settings && other.shape->inside(other.to_body(x));
  });
}

/// Whether the body goes up to the face here: beyond it the water meets its image.
bool goes_on(const NearSample& sample, double d) { return sample.reach >= -kAtFace * d; }

std::string describe_end(const Scene& scene, double support_radius, const Face& face, const PlacedShape& body,
                         const NearSample& sample) {
  const char axis = "xyz"[face.axis];
  const std::string cure =
      body.settings->drive == BodyDrive::kFree ? "" : "let it reach the face, where it goes on as its image, or ";
  return fmt::format(
      "{}: it ends {:.3g} m before the mirrored face {} = {:g} m, near ({:.3g}, {:.3g}, {:.3g}) m. Water passes the "
      "gap, "
      "which is too narrow for particles of {:g} m to flow as water would: {}keep it {:g} m away from the face (a "
      "support radius)",
      body.name(), -sample.reach, axis, face.place, sample.place.x(), sample.place.y(), sample.place.z(),
      scene.particle_spacing, cure, support_radius);
}

/// The sample that is nearest to the face of those that nothing beyond it holds.
std::optional<NearSample> find_end(const Scene& scene, const PlacedShape& body, std::span<const PlacedShape> bodies,
                                   std::span<const NearSample> own, std::span<const NearSample> beyond) {
  std::optional<NearSample> end;
  for (const NearSample& sample : own) {
    if (goes_on(sample, scene.particle_spacing) || (end && sample.reach <= end->reach)) continue;
    if (is_held(sample, beyond, scene.particle_spacing) || is_buried(body, bodies, sample.place)) continue;
    end = sample;
  }
  return end;
}

}  // namespace

std::vector<std::string> mirrored_face_notes(const Scene& scene, double support_radius, double level,
                                             std::span<const PlacedShape> bodies) {
  std::vector<std::string> notes;
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.patch_edges[static_cast<std::size_t>(axis)] != PatchEdge::kMirror) continue;
    for (const bool upper : {false, true}) {
      const Face face{axis, upper, upper ? scene.patch.max[axis] : scene.patch.min[axis]};
      // Above the water a body may end where it likes.
      if (axis == 2 && upper && face.place > level + scene.particle_spacing) continue;
      std::vector<std::vector<NearSample>> of_body;
      std::vector<NearSample> beyond;
      for (const PlacedShape& body : bodies) {
        of_body.push_back(samples_near(scene, face, level, support_radius, body));
        std::copy_if(of_body.back().begin(), of_body.back().end(), std::back_inserter(beyond),
                     [&](const NearSample& sample) { return goes_on(sample, scene.particle_spacing); });
      }
      for (std::size_t k = 0; k < bodies.size(); ++k)
        if (const auto end = find_end(scene, bodies[k], bodies, of_body[k], beyond))
          notes.push_back(describe_end(scene, support_radius, face, bodies[k], *end));
    }
  }
  return notes;
}

}  // namespace pelagos
