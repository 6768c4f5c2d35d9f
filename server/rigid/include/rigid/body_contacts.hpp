#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <memory>

#include "rigid/free_body.hpp"
#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// Keeps bodies out of one another, of scenery and of walls: water alone would let a heavy hull sink through a quay.
/// Free bodies touch as the convex hulls of their meshes, driven ones too; scenery touches as it is. Contacts are
/// inelastic, with Coulomb friction. What two bodies do to each other here is no load of the water.
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

  /// The half space behind a plane through `point` (m) is solid. @param normal  unit, into the free side
  void add_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
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

  /// Velocities of a free hull's centre after it.
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t hull) const;
  [[nodiscard]] Eigen::Vector3d angular_velocity(std::size_t hull) const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace pelagos
