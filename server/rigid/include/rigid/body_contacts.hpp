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

/// A point at which two bodies touch, as the solver carries it from step to step.
struct ContactPoint {
  Eigen::Vector3d local_a = Eigen::Vector3d::Zero(), local_b = Eigen::Vector3d::Zero();      ///< m, axes of each body
  Eigen::Vector3d world_a = Eigen::Vector3d::Zero(), world_b = Eigen::Vector3d::Zero();      ///< m
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();                                          ///< world axes, out of b
  std::array<Eigen::Vector3d, 2> lateral{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  ///< of the friction
  double distance = 0.0;                                                                     ///< m
  std::array<double, 3> impulse{};  ///< N s, along the normal and both lateral directions
  double previous_error = 0.0;      ///< of the solver
  std::array<int, 4> place{};       ///< parts and triangles of the shapes
  int flags = 0;
  int age = 0;  ///< steps

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("local_a", self.local_a);
    visit("local_b", self.local_b);
    visit("world_a", self.world_a);
    visit("world_b", self.world_b);
    visit("normal", self.normal);
    visit("lateral", self.lateral);
    visit("distance", self.distance);
    visit("impulse", self.impulse);
    visit("previous_error", self.previous_error);
    visit("place", self.place);
    visit("flags", self.flags);
    visit("age", self.age);
  }
};

/// Two bodies that touch, by their order of addition.
struct ContactPair {
  int a = 0, b = 0;
  std::vector<ContactPoint> points;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("a", self.a);
    visit("b", self.b);
    visit("points", self.points);
  }
};

/// What contacts remember from step to step: points and impulses, with which the next solve starts.
struct ContactState {
  std::vector<ContactPair> pairs;  ///< by a, then b

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("pairs", self.pairs);
  }
};

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

  /// Whether a plane rubs. A mirrored side of the patch does not: it stands for the other half of what touches it.
  enum class Face { kRough, kSmooth };
  /// The half space behind a plane through `point` (m) is solid. @param normal  unit, into the free side
  void add_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, Face face = Face::kRough);
  /// Scenery, at its place for good; a closed mesh or an open one.
  void add_scenery(const TriangleMesh& mesh, const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation);
  /// A hull that is moved by others and gives way to nothing. Returns its number among the moving ones.
  std::size_t add_driven(const TriangleMesh& mesh);
  /// A hull that gives way.
  std::size_t add_free(const TriangleMesh& mesh, const BodyMass& mass, const Freedoms& freedoms = {});

  /// Says where a moving hull is: of a driven one its origin and the velocities there, of a free one that of `body`.
  void place_driven(std::size_t hull, const BodyState& state);
  void place_free(std::size_t hull, const FreeBody& body);

  /// Takes out of the velocities what would drive hulls into something within dt (s), and pushes apart what overlaps.
  /// Returns whether anything touches.
  bool resolve(double dt);

  [[nodiscard]] ContactState state() const;
  /// Goes on from a state; hulls stand where they stood then.
  void restore(const ContactState& state);

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
