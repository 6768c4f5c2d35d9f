#include "shapes/file_digest.hpp"
#include "simulation/bodies.hpp"

namespace pelagos {

namespace {

BodySurface describe(const BodySettings& settings, const BodyShape& shape) {
  BodySurface surface;
  surface.file_digest = file_digest(settings.mesh_file);
  surface.low = shape.bounding_box.min();
  surface.high = shape.bounding_box.max();
  surface.triangle_count = static_cast<std::uint32_t>(shape.mesh.triangles.size());
  if (surface.triangle_count > BodySurface::kMostTriangles) return surface;
  for (const Eigen::Vector3d& vertex : shape.mesh.vertices) surface.vertices.push_back(vertex.cast<float>());
  surface.triangles = shape.mesh.triangles;
  return surface;
}

}  // namespace

std::shared_ptr<const BodySurface> Bodies::surface_of(std::uint32_t id) const {
  for (const Body& body : bodies_)
    if (body.settings.id == id && !body.settings.primitive)
      return std::make_shared<const BodySurface>(describe(body.settings, body.shape));
  return nullptr;
}

}  // namespace pelagos
