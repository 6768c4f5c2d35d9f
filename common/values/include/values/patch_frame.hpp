#pragma once

#include "values/scene.hpp"

namespace pelagos {

/// Where the simulated patch of water is, and how its faces close it. All that lies in the patch has local coordinates:
/// metres from its origin, axes parallel to the world's. Whoever needs the one for the other asks here.
struct PatchFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, world: local zero
  Box box;                                           ///< m, world
  PatchEdges edges = kWallsAround;                   ///< how the faces across x, y, z close it

  /// A frame of which no more is known than its origin, as of a slick that a viewer has received.
  [[nodiscard]] static PatchFrame at(const Eigen::Vector3d& origin) { return {origin, {}, kWallsAround}; }

  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& world) const { return world - origin; }
  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& local) const { return local + origin; }
  [[nodiscard]] Eigen::Vector2d to_local(const Eigen::Vector2d& world) const { return world - origin.head<2>(); }
  [[nodiscard]] Eigen::Vector2d to_world(const Eigen::Vector2d& local) const { return local + origin.head<2>(); }
  [[nodiscard]] double local_height(double world) const { return world - origin.z(); }
  [[nodiscard]] double world_height(double local) const { return local + origin.z(); }
  [[nodiscard]] Box local_box() const { return {to_local(box.min), to_local(box.max)}; }
  /// The same patch elsewhere. @param way  m
  [[nodiscard]] PatchFrame moved(const Eigen::Vector3d& way) const {
    return {origin + way, {box.min + way, box.max + way}, edges};
  }
  /// m, world: how far this frame has moved from where it was.
  [[nodiscard]] Eigen::Vector3d way_from(const PatchFrame& before) const { return origin - before.origin; }
  /// m, world: the middle of its area.
  [[nodiscard]] Eigen::Vector2d middle() const { return 0.5 * (box.min + box.max).head<2>(); }
  /// Whether a place (m, world) lies in the patch, above or below it.
  [[nodiscard]] bool covers(const Eigen::Vector2d& world) const {
    return (world.array() >= box.min.head<2>().array()).all() && (world.array() <= box.max.head<2>().array()).all();
  }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("origin", self.origin);
    visit("min", self.box.min);
    visit("max", self.box.max);
    visit("edges", self.edges);
  }
};

/// That of a scene. Its origin is the middle of the floor's area at its lower z, so that floats keep their digits near
/// the ship.
[[nodiscard]] inline PatchFrame patch_frame(const Scene& scene) {
  const Eigen::Vector3d middle = 0.5 * (scene.patch.min + scene.patch.max);
  return {{middle.x(), middle.y(), scene.patch.min.z()}, scene.patch, scene.patch_edges};
}

}  // namespace pelagos
