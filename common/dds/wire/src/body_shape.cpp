#include "wire/convert.hpp"

namespace pelagos::wire {

BodyShapeSample::BodyShapeSample(const BodySurface& surface, std::uint32_t body, std::uint64_t source) {
  for (const Eigen::Vector3f& vertex : surface.vertices)
    vertices_.insert(vertices_.end(), vertex.begin(), vertex.end());
  for (const auto& triangle : surface.triangles) corners_.insert(corners_.end(), triangle.begin(), triangle.end());
  sample_.source = source;
  sample_.body = body;
  sample_.digest = surface.file_digest;
  sample_.box_min = to_wire(surface.low);
  sample_.box_max = to_wire(surface.high);
  sample_.triangle_count = surface.triangle_count;
  const auto lend = [](auto& sequence, auto& items) {
    sequence._maximum = sequence._length = static_cast<std::uint32_t>(items.size());
    sequence._buffer = items.data();
    sequence._release = false;
  };
  lend(sample_.vertices, vertices_);
  lend(sample_.corners, corners_);
}

BodySurface from_wire(const pelagos_BodyShapeV1& wire) {
  BodySurface surface;
  surface.file_digest = wire.digest;
  surface.low = from_wire(wire.box_min);
  surface.high = from_wire(wire.box_max);
  surface.triangle_count = wire.triangle_count;
  const float* vertex = wire.vertices._buffer;
  for (std::uint32_t i = 0; i + 2 < wire.vertices._length; i += 3)
    surface.vertices.emplace_back(vertex[i], vertex[i + 1], vertex[i + 2]);
  const std::uint32_t* corner = wire.corners._buffer;
  for (std::uint32_t i = 0; i + 2 < wire.corners._length; i += 3)
    surface.triangles.push_back({corner[i], corner[i + 1], corner[i + 2]});
  return surface;
}

}  // namespace pelagos::wire
