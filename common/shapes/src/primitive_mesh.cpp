#include <cmath>
#include <numbers>
#include <span>

#include "shapes/primitive.hpp"

namespace pelagos {

namespace {

constexpr std::uint32_t kSides = 64;  ///< of round shapes
constexpr int kRings = 16;            ///< from a pole of a sphere to its equator

/// A point of the outline that is turned about z.
struct OutlinePoint {
  double radius, height;
};

TriangleMesh box_mesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.vertices.emplace_back((n & 1 ? 0.5 : -0.5) * size.x(), (n & 2 ? 0.5 : -0.5) * size.y(),
                               (n & 4 ? 0.5 : -0.5) * size.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Volume of the polyhedron that turning the outline makes: frustums with regular polygons for sections.
double turned_volume(std::span<const OutlinePoint> outline) {
  const double section = 0.5 * kSides * std::sin(2.0 * std::numbers::pi / kSides);  // of radius 1
  double volume = 0.0;
  for (std::size_t k = 1; k < outline.size(); ++k) {
    const double a = outline[k - 1].radius, b = outline[k].radius;
    volume += section * (outline[k].height - outline[k - 1].height) * (a * a + a * b + b * b) / 3.0;
  }
  return volume;
}

/// Turns an outline about z; it runs upwards and begins and ends on the axis. Widened to enclose `volume`.
TriangleMesh turn(std::span<const OutlinePoint> outline, double volume) {
  const double widening = std::sqrt(volume / turned_volume(outline));
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0, 0.0, outline.front().height);
  for (std::size_t k = 1; k + 1 < outline.size(); ++k)
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / kSides, radius = widening * outline[k].radius;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), outline[k].height);
    }
  mesh.vertices.emplace_back(0.0, 0.0, outline.back().height);
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto rings = static_cast<std::uint32_t>(outline.size() - 2);
  const auto at = [](std::uint32_t ring, std::uint32_t side) { return 1 + ring * kSides + side % kSides; };
  for (std::uint32_t side = 0; side < kSides; ++side) {
    mesh.triangles.push_back({0, at(0, side + 1), at(0, side)});
    mesh.triangles.push_back({top, at(rings - 1, side), at(rings - 1, side + 1)});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, side), at(ring, side + 1), at(ring + 1, side)});
      mesh.triangles.push_back({at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)});
    }
  }
  return mesh;
}

/// A sphere cut at its equator, the halves `gap` apart; whole where that is 0.
std::vector<OutlinePoint> capsule_outline(double radius, double gap) {
  std::vector<OutlinePoint> outline;
  const auto add_half = [&](int first, int last, double shift) {
    for (int k = first; k <= last; ++k) {
      const double angle = 0.5 * std::numbers::pi * k / kRings;
      const bool pole = k == -kRings || k == kRings;
      outline.push_back({pole ? 0.0 : radius * std::cos(angle), radius * std::sin(angle) + shift});
    }
  };
  add_half(-kRings, 0, -0.5 * gap);
  add_half(gap > 0.0 ? 0 : 1, kRings, 0.5 * gap);
  return outline;
}

struct MeshOf {
  TriangleMesh operator()(const BoxShape& box) const { return box_mesh(box.size); }
  TriangleMesh operator()(const SphereShape& sphere) const {
    return turn(capsule_outline(sphere.radius, 0.0), volume_of(sphere));
  }
  TriangleMesh operator()(const CylinderShape& c) const {
    const double end = 0.5 * c.length;
    const OutlinePoint outline[] = {{0.0, -end}, {c.radius, -end}, {c.radius, end}, {0.0, end}};
    return turn(outline, volume_of(c));
  }
  TriangleMesh operator()(const CapsuleShape& c) const {
    const double gap = c.length - 2.0 * c.radius;
    return turn(capsule_outline(c.radius, gap > 1e-6 * c.radius ? gap : 0.0), volume_of(c));
  }
};

}  // namespace

TriangleMesh make_mesh(const Primitive& primitive) { return std::visit(MeshOf{}, primitive); }

}  // namespace pelagos
