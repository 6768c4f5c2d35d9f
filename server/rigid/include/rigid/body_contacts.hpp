#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "rigid/free_body.hpp"
#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// Keeps bodies out of one another, of scenery and of walls: water alone would let a heavy hull sink through a quay.
/// Free bodies touch as the convex hulls of their meshes. Scenery and driven bodies touch as they are: a buoy may lie
/// between the walls of a dock. Contacts are inelastic, with Coulomb friction. What two bodies do to each other here is
/// no load of the water.
///
/// Detection and the sequential-impulse solver are those of the Bullet library, in double precision. The same calls
/// give the same bits.
class BodyContacts {
 public:
  /// @param length  m, a small length of the scene (the particle spacing): margins scale with it
  explicit BodyContacts(double length);
  ~BodyContacts();
  BodyContacts(BodyContacts&&) noexcept;
  BodyContacts& operator=(BodyContacts&&) noexcept;

  /// Whether a plane rubs. A mirrored side of the tank does not: it stands for the other half of what touches it.
  enum class Face { kRough, kSmooth };
  /// The half space behind a plane through `point` (m) is solid. @param normal  unit, into the free side
  void add_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, Face face = Face::kRough);
  /// Scenery, at its place for good; a closed mesh or an open one.
  void add_scenery(const TriangleMesh& mesh, const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation);
  /// A hull that is moved by others and gives way to nothing. Returns its number among the moving ones.
  std::size_t add_driven(const TriangleMesh& mesh);
  /// A hull that gives way.
  std::size_t add_free(const TriangleMesh& mesh, const BodyMass& mass, FreeBody::Freedom freedom);

  /// Says where a moving hull is: of a driven one its origin and the velocities there, of a free one that of `body`.
  void place_driven(std::size_t hull, const BodyState& state);
  void place_free(std::size_t hull, const FreeBody& body);

  /// Takes out of the velocities what would drive hulls into something within dt (s), and pushes apart what overlaps.
  /// Returns whether anything touches.
  bool resolve(double dt);

  /// Two shapes of which at least one is a convex hull that is larger than its mesh, and which overlap.
  struct Overlap {
    std::array<std::size_t, 2> shape{};  ///< numbered in the order in which scenery, driven and free hulls were added
    double depth = 0.0;                  ///< m
  };
  /// Those that overlap now by more than `depth` (m), in the order of their numbers.
  [[nodiscard]] std::vector<Overlap> hull_overlaps(double depth);

  /// Velocities of a free hull's centre after it.
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t hull) const;
  [[nodiscard]] Eigen::Vector3d angular_velocity(std::size_t hull) const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace pelagos
