#include "slanted_faces.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace pelagos {

namespace {

/// Cosines of a solid's and a face's normal: up to the first the two stand squarely, below the second the solid bends
/// away from the face, as a ball does that lies on it.
constexpr float kSquare = 0.1F, kBack = -0.6F;
/// Places that are looked at lie this far from the face, and outside the solid by so much, spacings. Nearer to the face
/// or to the solid its field rounds the edges of a body that ends at the face.
constexpr float kLayer = 1.0F, kNearest = 0.5F, kFarthest = 1.0F;
/// Between such places, spacings: some lie outside a slope by the distances above.
constexpr float kStep = 0.4F;
/// Between the nodes of a face's field, spacings: any number does, its distance is linear.
constexpr float kCell = 4.0F;

/// One face of the patch.
struct Face {
  std::size_t axis = 0;
  bool upper = false;

  [[nodiscard]] float place(const Region& patch) const { return upper ? patch.max[axis] : patch.min[axis]; }
  /// Along the axis, into the patch.
  [[nodiscard]] float inwards() const { return upper ? -1.0F : 1.0F; }
};

bool slants(const Solid& solid, const Face& face, const Eigen::Vector3f& place, float spacing) {
  const std::optional<Float4> found = surface_at(solid, place, kFarthest * spacing);
  if (!found || found->w < kNearest * spacing) return false;
  const std::array<float, 3> normal{found->x, found->y, found->z};
  const float cosine = face.inwards() * normal[face.axis];
  return std::abs(cosine) > kSquare && cosine > kBack;
}

/// Whether the solid meets the face at a slant at some place.
bool slants(const Solid& solid, const Face& face, const Region& patch, float spacing) {
  const float step = kStep * spacing;
  const std::size_t a = (face.axis + 1) % 3, b = (face.axis + 2) % 3;
  Eigen::Vector3f place;
  place[static_cast<int>(face.axis)] = face.place(patch) + face.inwards() * kLayer * spacing;
  const auto steps = [&](std::size_t axis) { return static_cast<int>((patch.max[axis] - patch.min[axis]) / step); };
  for (int j = 0; j <= steps(b); ++j)
    for (int i = 0; i <= steps(a); ++i) {
      place[static_cast<int>(a)] = patch.min[a] + static_cast<float>(i) * step;
      place[static_cast<int>(b)] = patch.min[b] + static_cast<float>(j) * step;
      if (slants(solid, face, place, spacing)) return true;
    }
  return false;
}

/// The half-space behind a face, in local axes, a cell beyond the patch all around.
Solid make_surface(const Face& face, const Region& patch, float spacing) {
  SolidField field;
  field.cell = kCell * spacing;
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool across = axis == face.axis;
    const float size = across ? 0.0F : patch.max[axis] - patch.min[axis];
    field.nodes[axis] = 3 + static_cast<int>(std::ceil(size / field.cell));
    field.origin[axis] = (across ? face.place(patch) : patch.min[axis]) - field.cell;
    count *= static_cast<std::size_t>(field.nodes[axis]);
  }
  const std::size_t row = static_cast<std::size_t>(field.nodes[0]),
                    layer = row * static_cast<std::size_t>(field.nodes[1]);
  field.values.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::array<std::size_t, 3> node{k % row, k % layer / row, k / layer};
    std::array<float, 3> normal{};
    normal[face.axis] = face.inwards();
    const float along = (static_cast<float>(node[face.axis]) - 1.0F) * field.cell;
    field.values[k] = {normal[0], normal[1], normal[2], face.inwards() * along};
  }
  Solid solid;
  solid.field = std::make_shared<const SolidField>(std::move(field));
  return solid;
}

}  // namespace

std::vector<Solid> take_slanted_faces(std::span<const Solid> standing, FluidParameters& parameters) {
  std::vector<Solid> surfaces;
  const auto spacing = static_cast<float>(parameters.spacing);
  bool side_taken = false;
  for (const std::size_t axis : {2U, 0U, 1U}) {
    if (parameters.edges[axis] != Edge::kMirror || (axis != 2U && side_taken)) continue;
    const std::array<Face, 2> faces{{{axis, false}, {axis, true}}};
    const bool slanted = std::any_of(standing.begin(), standing.end(), [&](const Solid& solid) {
      return std::any_of(faces.begin(), faces.end(),
                         [&](const Face& face) { return slants(solid, face, parameters.patch, spacing); });
    });
    if (!slanted) continue;
    for (const Face& face : faces) surfaces.push_back(make_surface(face, parameters.patch, spacing));
    parameters.edges[axis] = Edge::kOpen;
    side_taken = side_taken || axis != 2U;
  }
  return surfaces;
}

}  // namespace pelagos
