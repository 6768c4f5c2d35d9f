#include "rigid/body_contacts.hpp"

#include <btBulletCollisionCommon.h>
#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "rigid/convex_hull.hpp"
#include "scales/scales.hpp"

namespace pelagos {

namespace {

constexpr double kFriction = 0.4;  ///< steel on steel or on a wet quay, roughly
constexpr double kMargin = 0.02;   ///< of the length: shapes grow by so much
/// Share of an overlap that is pushed out in a step, as a velocity.
constexpr double kPushOut = 0.1;
/// An overlap is pushed out no faster than this, in sqrt(g length): a body that a driven one or its own pose has forced
/// deep into something comes out of it, and is not shot.
constexpr double kPushOutSpeed = 1.0;
/// |n_z| of what a led body may touch among things that do not give way. Its place is its leader's: it can answer a
/// floor or a slope by heaving, a wall or a quay's side by nothing but a wild roll.
constexpr double kLevel = 0.7;
/// Meshes that fill all but this share of their convex hull are convex: vertices in single precision leave 1e-6.
constexpr double kConvex = 1e-5;

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion to_bullet(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
Eigen::Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The axes in which a body's inertia is diagonal.
struct PrincipalAxes {
  Eigen::Quaterniond to_body = Eigen::Quaterniond::Identity();
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();  ///< kg m^2
};
PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  return {Eigen::Quaterniond(axes), solver.eigenvalues()};
}

}  // namespace

/// Owns what Bullet only borrows.
struct BodyContacts::World {
  explicit World(double scale) : length(scale) { bullet.setForceUpdateAllAabbs(false); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    for (const auto& body : bodies) bullet.removeCollisionObject(body.get());
  }

  struct Hull {
    btRigidBody* body = nullptr;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();             ///< m, body axes, of Bullet's body
    Eigen::Quaterniond to_body = Eigen::Quaterniond::Identity();  ///< from its axes
  };

  btRigidBody& add(std::unique_ptr<btCollisionShape> shape, double mass, const Eigen::Vector3d& moments) {
    bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, shape.get(), to_bullet(moments)));
    btRigidBody& body = *bodies.back();
    body.setFriction(kFriction);
    body.setRestitution(0.0);
    body.setFlags(0);  // gyroscopic moments are not Bullet's to add
    body.setActivationState(DISABLE_DEACTIVATION);
    shapes.push_back(std::move(shape));
    return body;
  }
  [[nodiscard]] double push_out_speed() const { return kPushOutSpeed * std::sqrt(kStandardGravity * length); }
  [[nodiscard]] static double reach(const btRigidBody& body) {
    btVector3 centre;
    btScalar radius = 0.0;
    body.getCollisionShape()->getBoundingSphere(centre, radius);
    return centre.length() + radius;
  }
  [[nodiscard]] static double fastest_point(const btRigidBody& body) {
    return body.getLinearVelocity().length() + body.getAngularVelocity().length() * reach(body);
  }
  /// Contacts that no answer exists for go, overlaps count up to a bound.
  void tame(btPersistentManifold& manifold, double deepest) const;
  /// No contact makes a body faster than everything that moved before it, and the push out of an overlap.
  void bound_speeds(double limit) const;
  /// All pairs that are near, in the order of their bodies: Bullet's own order depends on how they came near.
  [[nodiscard]] std::vector<btPersistentManifold*> manifolds();
  void publish(btRigidBody& body, int group, int mask) { bullet.addCollisionObject(&body, group, mask); }

  std::unique_ptr<btCollisionShape> hull_shape(const TriangleMesh& mesh, const Hull& hull) const {
    auto shape = std::make_unique<btConvexHullShape>();
    for (const Eigen::Vector3d& vertex : mesh.vertices)
      shape->addPoint(to_bullet(hull.to_body.conjugate() * (vertex - hull.centre)), false);
    shape->recalcLocalAabb();
    if (shape->getNumPoints() > 100) shape->optimizeConvexHull();
    shape->setMargin(kMargin * length);
    return shape;
  }

  /// The triangles as they are, turned and moved into the axes of Bullet's body.
  std::unique_ptr<btCollisionShape> triangle_shape(const TriangleMesh& mesh, const Eigen::Vector3d& position,
                                                   const Eigen::Quaterniond& orientation) {
    auto triangles = std::make_unique<btTriangleMesh>();
    const auto corner = [&](std::size_t t, std::size_t c) {
      return to_bullet(orientation * mesh.corner(t, c) + position);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      triangles->addTriangle(corner(t, 0), corner(t, 1), corner(t, 2));
    auto shape = std::make_unique<btBvhTriangleMeshShape>(triangles.get(), true);
    shape->setMargin(kMargin * length);
    meshes.push_back(std::move(triangles));
    return shape;
  }
  /// @param larger  whether its shape is larger than its mesh
  void number(btRigidBody& body, bool larger) {
    body.setUserIndex(static_cast<int>(larger_than_mesh.size()));
    larger_than_mesh.push_back(larger);
  }

  void place(const Hull& hull, const Eigen::Vector3d& centre, const Eigen::Quaterniond& orientation,
             const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity) {
    const btTransform transform(to_bullet(orientation * hull.to_body), to_bullet(centre));
    hull.body->setWorldTransform(transform);
    hull.body->setInterpolationWorldTransform(transform);
    hull.body->setLinearVelocity(to_bullet(velocity));
    hull.body->setAngularVelocity(to_bullet(angular_velocity));
    hull.body->updateInertiaTensor();
  }

  static constexpr int kFixedGroup = 1, kDrivenGroup = 2, kFreeGroup = 4;

  double length;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld bullet{&dispatcher, &broadphase, &configuration};
  btSequentialImpulseConstraintSolver solver;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<Hull> hulls;
  std::vector<bool> larger_than_mesh;  ///< by number
};

namespace {

bool gives_way(const btRigidBody& body) { return body.getInvMass() > 0.0; }
/// Numbers of a pair's bodies, by their order of addition.
std::pair<int, int> bodies_of(const btPersistentManifold& manifold) {
  return {manifold.getBody0()->getWorldArrayIndex(), manifold.getBody1()->getWorldArrayIndex()};
}

ContactPoint from_bullet(const btManifoldPoint& p) {
  ContactPoint point;
  point.local_a = from_bullet(p.m_localPointA);
  point.local_b = from_bullet(p.m_localPointB);
  point.world_a = from_bullet(p.m_positionWorldOnA);
  point.world_b = from_bullet(p.m_positionWorldOnB);
  point.normal = from_bullet(p.m_normalWorldOnB);
  point.lateral = {from_bullet(p.m_lateralFrictionDir1), from_bullet(p.m_lateralFrictionDir2)};
  point.distance = p.m_distance1;
  point.impulse = {p.m_appliedImpulse, p.m_appliedImpulseLateral1, p.m_appliedImpulseLateral2};
  point.previous_error = p.m_prevRHS;
  point.place = {p.m_partId0, p.m_index0, p.m_partId1, p.m_index1};
  point.flags = p.m_contactPointFlags;
  point.age = p.m_lifeTime;
  return point;
}

btManifoldPoint to_bullet(const ContactPoint& point) {
  btManifoldPoint p(to_bullet(point.local_a), to_bullet(point.local_b), to_bullet(point.normal), point.distance);
  p.m_positionWorldOnA = to_bullet(point.world_a);
  p.m_positionWorldOnB = to_bullet(point.world_b);
  p.m_combinedFriction = kFriction * kFriction;  // of two bodies, as Bullet combines them
  p.m_lateralFrictionDir1 = to_bullet(point.lateral[0]);
  p.m_lateralFrictionDir2 = to_bullet(point.lateral[1]);
  p.m_appliedImpulse = point.impulse[0];
  p.m_appliedImpulseLateral1 = point.impulse[1];
  p.m_appliedImpulseLateral2 = point.impulse[2];
  p.m_prevRHS = point.previous_error;
  p.m_partId0 = point.place[0];
  p.m_index0 = point.place[1];
  p.m_partId1 = point.place[2];
  p.m_index1 = point.place[3];
  p.m_contactPointFlags = point.flags;
  p.m_lifeTime = point.age;
  return p;
}

bool is_led(const btRigidBody& body) { return gives_way(body) && body.getLinearFactor().x() == 0.0; }
bool goes_anywhere(const btRigidBody& body) { return gives_way(body) && !is_led(body); }

}  // namespace

void BodyContacts::World::tame(btPersistentManifold& manifold, double deepest) const {
  // All that is in this world are rigid bodies.
  const btRigidBody &a = *btRigidBody::upcast(manifold.getBody0()), &b = *btRigidBody::upcast(manifold.getBody1());
  const bool stuck = (is_led(a) || is_led(b)) && !goes_anywhere(a) && !goes_anywhere(b);
  for (int k = manifold.getNumContacts() - 1; k >= 0; --k) {
    btManifoldPoint& point = manifold.getContactPoint(k);
    if (stuck && std::abs(point.m_normalWorldOnB.z()) < kLevel)
      manifold.removeContactPoint(k);
    else if (point.getDistance() < -deepest)
      point.setDistance(-deepest);
  }
}

std::vector<btPersistentManifold*> BodyContacts::World::manifolds() {
  std::vector<btPersistentManifold*> all;
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) all.push_back(dispatcher.getManifoldByIndexInternal(k));
  std::sort(all.begin(), all.end(), [](const btPersistentManifold* one, const btPersistentManifold* other) {
    return bodies_of(*one) < bodies_of(*other);
  });
  return all;
}

void BodyContacts::World::bound_speeds(double limit) const {
  for (const auto& body : bodies) {
    if (!gives_way(*body)) continue;
    const double speed = body->getLinearVelocity().length(), rim = body->getAngularVelocity().length() * reach(*body);
    if (speed > limit) body->setLinearVelocity(body->getLinearVelocity() * (limit / speed));
    if (rim > limit) body->setAngularVelocity(body->getAngularVelocity() * (limit / rim));
  }
}

BodyContacts::BodyContacts(double length) : world_(std::make_unique<World>(length)) {}
BodyContacts::~BodyContacts() = default;
BodyContacts::BodyContacts(BodyContacts&&) noexcept = default;
BodyContacts& BodyContacts::operator=(BodyContacts&&) noexcept = default;

/// Shapes grow by their margin: the plane stands back by as much, so a body that just fits between two is not wedged.
void BodyContacts::add_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, Face face) {
  const double offset = normal.dot(point) - kMargin * world_->length;
  auto shape = std::make_unique<btStaticPlaneShape>(to_bullet(normal), offset);
  shape->setMargin(0.0);
  btRigidBody& body = world_->add(std::move(shape), 0.0, Eigen::Vector3d::Zero());
  if (face == Face::kSmooth) body.setFriction(0.0);
  world_->publish(body, World::kFixedGroup, World::kFreeGroup);
}

void BodyContacts::add_scenery(const TriangleMesh& mesh, const Eigen::Vector3d& position,
                               const Eigen::Quaterniond& orientation) {
  btRigidBody& body = world_->add(world_->triangle_shape(mesh, position, orientation), 0.0, Eigen::Vector3d::Zero());
  world_->number(body, false);
  world_->publish(body, World::kFixedGroup, World::kFreeGroup);
}

std::size_t BodyContacts::add_driven(const TriangleMesh& mesh) {
  World::Hull hull;
  auto shape = hollow_share(mesh) > kConvex
                   ? world_->triangle_shape(mesh, Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity())
                   : world_->hull_shape(mesh, hull);
  hull.body = &world_->add(std::move(shape), 0.0, Eigen::Vector3d::Zero());
  world_->number(*hull.body, false);
  hull.body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  world_->publish(*hull.body, World::kDrivenGroup, World::kFreeGroup);
  world_->hulls.push_back(hull);
  return world_->hulls.size() - 1;
}

std::size_t BodyContacts::add_free(const TriangleMesh& mesh, const BodyMass& mass, const Freedoms& freedoms) {
  const PrincipalAxes axes = principal_axes(mass.inertia);
  World::Hull hull{nullptr, mass.centre, axes.to_body};
  hull.body = &world_->add(world_->hull_shape(mesh, hull), mass.mass, axes.moments);
  world_->number(*hull.body, hollow_share(mesh) > kConvex);
  hull.body->setLinearFactor(to_bullet(freedoms.along));
  hull.body->setAngularFactor(to_bullet(freedoms.about));
  world_->publish(*hull.body, World::kFreeGroup, World::kFixedGroup | World::kDrivenGroup | World::kFreeGroup);
  world_->hulls.push_back(hull);
  return world_->hulls.size() - 1;
}

void BodyContacts::place_driven(std::size_t hull, const BodyState& state) {
  world_->place(world_->hulls[hull], state.position, state.orientation, state.velocity, state.angular_velocity);
}

void BodyContacts::place_free(std::size_t hull, const FreeBody& body) {
  world_->place(world_->hulls[hull], body.centre(), body.orientation(), body.velocity(), body.angular_velocity());
}

bool BodyContacts::resolve(double dt) {
  World& w = *world_;
  w.bullet.performDiscreteCollisionDetection();
  std::vector<btPersistentManifold*> touching;
  for (btPersistentManifold* manifold : w.manifolds()) {
    w.tame(*manifold, w.push_out_speed() * dt / kPushOut);
    if (manifold->getNumContacts() > 0) touching.push_back(manifold);
  }
  if (touching.empty()) return false;
  double fastest = 0.0;
  for (const auto& body : w.bodies) fastest = std::max(fastest, World::fastest_point(*body));
  btContactSolverInfo settings;
  settings.m_timeStep = dt;
  settings.m_erp = settings.m_erp2 = kPushOut;
  settings.m_splitImpulse = 0;
  settings.m_restitutionVelocityThreshold = 0.0;
  btAlignedObjectArray<btCollisionObject*>& objects = w.bullet.getCollisionObjectArray();
  w.solver.prepareSolve(objects.size(), static_cast<int>(touching.size()));
  w.solver.solveGroup(&objects[0], objects.size(), touching.data(), static_cast<int>(touching.size()), nullptr, 0,
                      settings, nullptr, &w.dispatcher);
  w.bound_speeds(fastest + w.push_out_speed());
  return true;
}

ContactState BodyContacts::state() const {
  ContactState state;
  for (const btPersistentManifold* manifold : world_->manifolds()) {
    if (manifold->getNumContacts() == 0) continue;
    const auto [a, b] = bodies_of(*manifold);
    ContactPair& pair = state.pairs.emplace_back(ContactPair{a, b, {}});
    for (int k = 0; k < manifold->getNumContacts(); ++k)
      pair.points.push_back(from_bullet(manifold->getContactPoint(k)));
  }
  return state;
}

void BodyContacts::restore(const ContactState& state) {
  World& w = *world_;
  w.bullet.performDiscreteCollisionDetection();  // the pairs that are near
  for (btPersistentManifold* manifold : w.manifolds()) {
    while (manifold->getNumContacts() > 0) manifold->removeContactPoint(manifold->getNumContacts() - 1);
    const auto bodies = bodies_of(*manifold);
    for (const ContactPair& pair : state.pairs)
      if (bodies == std::pair{pair.a, pair.b})
        for (const ContactPoint& point : pair.points) manifold->addManifoldPoint(to_bullet(point));
  }
}

std::vector<BodyContacts::Overlap> BodyContacts::hull_overlaps(double depth) {
  World& w = *world_;
  if (std::find(w.larger_than_mesh.begin(), w.larger_than_mesh.end(), true) == w.larger_than_mesh.end()) return {};
  w.bullet.performDiscreteCollisionDetection();
  std::map<std::pair<int, int>, double> deepest;
  for (int k = 0; k < w.dispatcher.getNumManifolds(); ++k) {
    const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(k);
    const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
    if (a < 0 || b < 0) continue;  // a plane
    const auto is_larger = [&](int shape) { return w.larger_than_mesh[static_cast<std::size_t>(shape)]; };
    if (!is_larger(a) && !is_larger(b)) continue;
    double& found = deepest[std::minmax(a, b)];
    for (int n = 0; n < manifold.getNumContacts(); ++n)
      found = std::max(found, -manifold.getContactPoint(n).getDistance());
  }
  std::vector<Overlap> overlaps;
  for (const auto& [pair, found] : deepest)
    if (found > depth)
      overlaps.push_back({{static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second)}, found});
  return overlaps;
}

Eigen::Vector3d BodyContacts::velocity(std::size_t hull) const {
  return from_bullet(world_->hulls[hull].body->getLinearVelocity());
}

Eigen::Vector3d BodyContacts::angular_velocity(std::size_t hull) const {
  return from_bullet(world_->hulls[hull].body->getAngularVelocity());
}

}  // namespace pelagos
