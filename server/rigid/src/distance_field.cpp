#include "rigid/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "surface_patches.hpp"

namespace pelagos {

namespace {

/// A place so near to the surface has the direction of its face.
constexpr double kOnSurface = 1e-6;  // cells
/// Looked at along the way from a node to the surface: solid there hides the surface.
constexpr std::array<double, 3> kAlongTheWay{0.25, 0.5, 0.75};

/// A patch of a body's surface, as nodes ask it.
struct Patch {
  const BodyShape* body;
  std::shared_ptr<const MeshQuery> query;
  bool whole;  ///< it is all of the body's surface

  [[nodiscard]] bool behind(const Eigen::Vector3d& x, const NearestPlace& found) const {
    return whole && body->kind == MeshKind::kClosed ? body->inside(x) : found.height < 0.0;
  }
  /// Whether another part of the body lies between a place in the water and its nearest place of this patch.
  [[nodiscard]] bool is_hidden(const Eigen::Vector3d& x, const Eigen::Vector3d& place) const {
    if (whole || body->inside(x)) return false;
    return std::any_of(kAlongTheWay.begin(), kAlongTheWay.end(),
                       [&](double t) { return body->inside(x + t * (place - x)); });
  }
};

Float4 node_value(const Patch& patch, const Eigen::Vector3d& x, double limit, double cell) {
  const auto far = static_cast<float>(limit);
  const auto found = patch.query->nearest(x, limit);
  if (!found || patch.is_hidden(x, found->place)) return {0.0F, 0.0F, 0.0F, far};
  const bool behind = patch.behind(x, *found);
  const Eigen::Vector3d apart = x - found->place;
  const Eigen::Vector3d normal = found->distance > kOnSurface * cell
                                     ? Eigen::Vector3d((behind ? -1.0 : 1.0) / found->distance * apart)
                                     : found->normal;
  const Eigen::Vector3f n = normal.cast<float>();
  return {n.x(), n.y(), n.z(), static_cast<float>(behind ? -found->distance : found->distance)};
}

/// The grid of a patch, without values.
SolidField empty_field(const Patch& patch, const FieldExtent& extent) {
  SolidField field;
  const double margin = extent.reach + extent.cell();
  Eigen::AlignedBox3d box = patch.query->bounding_box();
  box = Eigen::AlignedBox3d(box.min().array() - margin, box.max().array() + margin).intersection(extent.within);
  if (box.isEmpty()) return field;
  field.cell = static_cast<float>(extent.cell());
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    field.origin[a] = static_cast<float>(box.min()[axis]);
    field.nodes[a] = static_cast<int>(std::min(std::ceil(box.sizes()[axis] / extent.cell()), 1e6)) + 1;
  }
  return field;
}

double node_count(const SolidField& field) {
  return static_cast<double>(field.nodes[0]) * static_cast<double>(field.nodes[1]) *
         static_cast<double>(field.nodes[2]);
}

void fill_field(TaskPool& pool, const Patch& patch, const FieldExtent& extent, SolidField& field) {
  const auto nx = static_cast<std::size_t>(field.nodes[0]), ny = static_cast<std::size_t>(field.nodes[1]);
  const std::size_t rows = ny * static_cast<std::size_t>(field.nodes[2]);
  field.values.resize(nx * rows);
  const double limit = extent.reach + 2.0 * extent.cell();
  pool.for_each_range(rows, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (std::size_t i = 0; i < nx; ++i) {
        const Eigen::Vector3f at(static_cast<float>(i), static_cast<float>(row % ny), static_cast<float>(row / ny));
        const Eigen::Vector3f x = Eigen::Vector3f(field.origin[0], field.origin[1], field.origin[2]) + field.cell * at;
        field.values[row * nx + i] = node_value(patch, x.cast<double>(), limit, extent.cell());
      }
  });
}

/// Sum of the principal curvatures, 1/m, positive where the solid bulges: the divergence of the normals. Nothing where
/// a node around has no direction.
std::optional<float> curvature_at(const SolidField& field, const std::array<int, 3>& node) {
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(field.nodes[0]),
      static_cast<std::size_t>(field.nodes[0]) * static_cast<std::size_t>(field.nodes[1])};
  std::size_t at = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (node[axis] < 1 || node[axis] + 1 >= field.nodes[axis]) return std::nullopt;
    at += stride[axis] * static_cast<std::size_t>(node[axis]);
  }
  float sum = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Float4 &low = field.values[at - stride[axis]], &high = field.values[at + stride[axis]];
    for (const Float4& n : {low, high})
      if (n.x == 0.0F && n.y == 0.0F && n.z == 0.0F) return std::nullopt;
    sum += axis == 0 ? high.x - low.x : axis == 1 ? high.y - low.y : high.z - low.z;
  }
  return sum / (2.0F * field.cell);
}

/// Moves the surface inwards where it bulges: image pairs count the half space behind the tangent plane, of which a
/// bulging solid fills less. Calibrated on the buoyancy of spheres of 3 to 8 spacings radius.
void allow_for_curvature(double spacing, SolidField& field) {
  constexpr float kShift = 0.075F, kMostCurvature = 0.7F;  // spacings^2 by curvature; 1/spacing
  const auto d = static_cast<float>(spacing);
  std::vector<float> shift(field.values.size(), 0.0F);
  std::size_t at = 0;
  for (int k = 0; k < field.nodes[2]; ++k)
    for (int j = 0; j < field.nodes[1]; ++j)
      for (int i = 0; i < field.nodes[0]; ++i, ++at)
        if (const auto curvature = curvature_at(field, {i, j, k}))
          shift[at] = kShift * d * d * std::clamp(*curvature, -kMostCurvature / d, kMostCurvature / d);
  for (std::size_t n = 0; n < shift.size(); ++n) field.values[n].w += shift[n];
}

}  // namespace

double thin_share(const BodyShape& shape, double least) {
  const double tiny = 1e-9 * shape.bounding_box.sizes().maxCoeff();
  double thin = 0.0, all = 0.0;
  for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
    const Eigen::Vector3d a = shape.mesh.corner(t, 0), b = shape.mesh.corner(t, 1), c = shape.mesh.corner(t, 2);
    const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
    all += area.norm();
    if (shape.surface->first_hit((a + b + c) / 3.0, -area.normalized(), tiny) < least) thin += area.norm();
  }
  return all > 0.0 ? thin / all : 0.0;
}

std::vector<std::shared_ptr<const SolidField>> make_distance_fields(TaskPool& pool, const BodyShape& shape,
                                                                    const FieldExtent& extent) {
  std::vector<Patch> patches;
  const std::vector<TriangleMesh> parts = smooth_patches(shape.mesh);
  for (const TriangleMesh& part : parts)
    patches.push_back(
        {&shape, parts.size() == 1 ? shape.surface : std::make_shared<const MeshQuery>(part), parts.size() == 1});
  std::vector<SolidField> fields;
  double nodes = 0.0;
  for (const Patch& patch : patches) nodes += node_count(fields.emplace_back(empty_field(patch, extent)));
  std::vector<std::shared_ptr<const SolidField>> made;
  if (nodes > kMostFieldNodes) return made;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (fields[k].nodes[0] < 2) continue;
    fill_field(pool, patches[k], extent, fields[k]);
    allow_for_curvature(extent.spacing, fields[k]);
    made.push_back(std::make_shared<const SolidField>(std::move(fields[k])));
  }
  return made;
}

}  // namespace pelagos
