#include "rigid/free_body.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "rigid/body_contacts.hpp"
#include "rigid/turn.hpp"
#include "shapes/primitive.hpp"

namespace pelagos {
namespace {

BodyMass brick() {
  MassSettings settings;
  settings.density = 500.0;
  return body_mass(settings, mass_properties(make_mesh(BoxShape{{3.0, 2.0, 1.0}})));
}

TEST(BodyMass, OfASolidFollowsItsShape) {
  const BodyMass body = brick();
  EXPECT_NEAR(body.mass, 3000.0, 1e-9);
  EXPECT_NEAR(body.centre.norm(), 0.0, 1e-12);
  EXPECT_NEAR(body.inertia(0, 0), 3000.0 / 12.0 * (4.0 + 1.0), 1e-6);
  EXPECT_NEAR(body.inertia(2, 2), 3000.0 / 12.0 * (9.0 + 4.0), 1e-6);
}

TEST(BodyMass, TakesWhatIsGiven) {
  MassSettings settings;
  settings.mass = 700.0;
  settings.centre = Eigen::Vector3d(0.1, 0.2, -0.3);
  settings.gyration = Eigen::Vector3d(1.0, 2.0, 2.1);
  const BodyMass body = body_mass(settings, mass_properties(make_mesh(BoxShape{{3.0, 2.0, 1.0}})));
  EXPECT_EQ(body.mass, 700.0);
  EXPECT_EQ(body.centre, *settings.centre);
  EXPECT_NEAR(body.inertia(1, 1), 2800.0, 1e-9);
}

TEST(FreeBody, FallsAndKeepsItsHorizontalSpeed) {
  BodyState start;
  start.velocity = {2.0, 0.0, 0.0};
  for (const auto order : {FreeBody::Order::kDriftFirst, FreeBody::Order::kGravityFirst}) {
    FreeBody body(start, brick());
    for (int k = 0; k < 1000; ++k) body.predict(1e-3, 9.81, order);
    EXPECT_NEAR(body.velocity().z(), -9.81, 1e-9);
    EXPECT_NEAR(body.centre().z(), -0.5 * 9.81, 0.01);
    EXPECT_NEAR(body.centre().x(), 2.0, 1e-9);
  }
}

TEST(FreeBody, SpinsAboutItsMiddleAxisWithoutGainOrLoss) {
  // The motion about the axis of middle inertia is unstable: it turns over again and again (Euler 1758).
  BodyState start;
  start.angular_velocity = {0.01, 2.0, 0.01};
  FreeBody body(start, brick());
  const Eigen::Vector3d momentum = body.angular_momentum();
  const double energy = 0.5 * body.angular_velocity().dot(momentum);
  double least = 1.0;
  for (int k = 0; k < 20000; ++k) {
    body.predict(2e-3, 0.0, FreeBody::Order::kDriftFirst);
    least = std::min(least, (body.orientation() * Eigen::Vector3d::UnitY()).y());
  }
  EXPECT_LT(least, -0.9) << "it has not turned over";
  EXPECT_LT((body.angular_momentum() - momentum).norm(), 1e-9 * momentum.norm());
  EXPECT_NEAR(0.5 * body.angular_velocity().dot(body.angular_momentum()), energy, 0.1 * energy);
}

TEST(FreeBody, IsAboutItsCentreOfMassAndSpeaksOfItsOrigin) {
  MassSettings settings;
  settings.mass = 100.0;
  settings.centre = Eigen::Vector3d(1.0, 0.0, 0.0);
  BodyState state;
  state.position = {5.0, 6.0, 7.0};
  state.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  state.angular_velocity = {0.0, 0.0, 3.0};
  FreeBody body(state, body_mass(settings, mass_properties(make_mesh(BoxShape{{4.0, 2.0, 2.0}}))));
  EXPECT_LT((body.centre() - Eigen::Vector3d(5.0, 7.0, 7.0)).norm(), 1e-12);
  EXPECT_LT((body.velocity() - Eigen::Vector3d(-3.0, 0.0, 0.0)).norm(), 1e-12);
  BodyState back = state;
  body.write_to(back);
  EXPECT_LT((back.position - state.position).norm(), 1e-12);
  EXPECT_LT((back.velocity - state.velocity).norm(), 1e-12);
}

TEST(FreeBody, LedInTheHorizontalKeepsHeaveRollAndPitch) {
  BodyState state;
  state.position = {0.0, 0.0, 2.0};
  state.orientation = rotation_of({0.3, 0.0, 0.0});
  state.angular_velocity = {0.5, 0.0, 0.0};
  FreeBody body(state, brick(), Freedoms::heave_roll_pitch());
  BodyState leader;
  leader.position = {10.0, -4.0, 99.0};
  leader.orientation = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()) * rotation_of({0.0, 0.2, 0.0});
  leader.velocity = {1.0, 2.0, 50.0};
  leader.angular_velocity = {9.0, 9.0, 0.1};
  body.lead(leader);
  body.write_to(state);
  EXPECT_LT((state.position - Eigen::Vector3d(10.0, -4.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((state.velocity - Eigen::Vector3d(1.0, 2.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((state.angular_velocity - Eigen::Vector3d(0.5, 0.0, 0.1)).norm(), 1e-12);
  const Eigen::Quaterniond tilt = yaw_of(state.orientation).conjugate() * state.orientation;
  EXPECT_LT(turn_of(tilt * rotation_of({0.3, 0.0, 0.0}).conjugate()).norm(), 1e-9);
  EXPECT_EQ(body.inverse_mass().head<2>(), Eigen::Vector2d::Zero());
}

TEST(FreeBody, ThatMayOnlyHeaveNeitherTurnsNorLeavesItsCourse) {
  BodyState start;
  start.velocity = {2.0, 0.5, 0.0};
  FreeBody body(start, brick(), {{0.0, 0.0, 1.0}, Eigen::Vector3d::Zero()});
  EXPECT_EQ(body.inverse_mass(), Eigen::Vector3d(0.0, 0.0, 1.0 / brick().mass));
  EXPECT_EQ(body.inverse_inertia(), Eigen::Matrix3d::Zero());
  for (int k = 0; k < 1000; ++k) body.predict(1e-3, 9.81, FreeBody::Order::kDriftFirst);
  EXPECT_NEAR(body.velocity().z(), -9.81, 1e-9);
  EXPECT_NEAR(body.centre().x(), 2.0, 1e-9);
  EXPECT_NEAR(body.centre().y(), 0.5, 1e-9);
  FreeBody fixed(start, brick(), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()});
  fixed.predict(1.0, 9.81, FreeBody::Order::kDriftFirst);
  EXPECT_EQ(fixed.velocity(), start.velocity) << "no weight along what is not free";
}

TEST(FreeBody, TurnsOnlyAboutTheAxesThatAreFree) {
  BodyState start;
  start.orientation = rotation_of({0.2, 0.4, 0.0});
  const FreeBody all(start, brick()), roll(start, brick(), {Eigen::Vector3d::Ones(), {1.0, 0.0, 0.0}});
  const Eigen::Matrix3d inertia = all.inverse_inertia().inverse();
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(0, 0) = 1.0 / inertia(0, 0);
  EXPECT_LT((roll.inverse_inertia() - expected).norm(), 1e-12 * expected.norm());
  const FreeBody tilts(start, brick(), Freedoms::heave_roll_pitch());
  const Eigen::Matrix2d corner = inertia.topLeftCorner<2, 2>().inverse();
  EXPECT_LT((tilts.inverse_inertia().topLeftCorner<2, 2>() - corner).norm(), 1e-12 * corner.norm());
  EXPECT_EQ(tilts.inverse_inertia().col(2), Eigen::Vector3d::Zero());
}

TEST(BodyContacts, StopABodyAtAPlaneAndLeaveItInTheAir) {
  BodyState start;
  start.position = {0.0, 0.0, 2.0};
  FreeBody body(start, brick());
  BodyContacts contacts(0.1);
  contacts.add_plane(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  const std::size_t hull = contacts.add_free(make_mesh(BoxShape{{3.0, 2.0, 1.0}}), brick());
  bool ever = false;
  for (int k = 0; k < 2000; ++k) {
    body.predict(1e-3, 9.81, FreeBody::Order::kDriftFirst);
    contacts.place_free(hull, body);
    const bool touches = contacts.resolve(1e-3);
    if (k < 400) {
      ASSERT_EQ(contacts.velocity(hull), body.velocity()) << "nothing is near at step " << k;
    }
    ever = ever || touches;
    body.take(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), contacts.velocity(hull),
              contacts.angular_velocity(hull));
    ASSERT_GT(body.centre().z(), 0.5 - 0.01);
  }
  EXPECT_TRUE(ever);
  EXPECT_NEAR(body.centre().z(), 0.5, 0.01);
  EXPECT_LT(body.velocity().norm(), 0.02);
}

/// How fast (m/s) a brick falls after half a second between two planes that it just fits between.
/// @param thrown  m/s, at the start
double fall_between_planes(BodyContacts::Face face, const Eigen::Vector3d& thrown) {
  BodyState start;
  start.velocity = thrown;
  FreeBody body(start, brick());
  BodyContacts contacts(0.1);
  for (const double side : {-1.0, 1.0})
    contacts.add_plane({-1.5 * side, 0.0, 0.0}, side * Eigen::Vector3d::UnitX(), face);
  const std::size_t hull = contacts.add_free(make_mesh(BoxShape{{3.0, 2.0, 1.0}}), brick());
  for (int k = 0; k < 500; ++k) {
    body.predict(1e-3, 9.81, FreeBody::Order::kDriftFirst);
    contacts.place_free(hull, body);
    contacts.resolve(1e-3);
    body.take(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), contacts.velocity(hull),
              contacts.angular_velocity(hull));
  }
  return -body.velocity().z();
}

TEST(BodyContacts, DoNotWedgeWhatJustFitsBetweenPlanes) {
  EXPECT_NEAR(fall_between_planes(BodyContacts::Face::kSmooth, {0, 0, 0}), 0.5 * 9.81, 1e-9);
  EXPECT_NEAR(fall_between_planes(BodyContacts::Face::kRough, {0, 0, 0}), 0.5 * 9.81, 0.05);
}

TEST(BodyContacts, OfSmoothPlanesDoNotRub) {
  EXPECT_NEAR(fall_between_planes(BodyContacts::Face::kSmooth, {5, 0, -3}), 3.0 + 0.5 * 9.81, 0.05);
  EXPECT_LT(fall_between_planes(BodyContacts::Face::kRough, {5, 0, -3}), 2.0 + 0.5 * 9.81);
}

TEST(BodyContacts, ShareMomentumBetweenBodies) {
  const TriangleMesh mesh = make_mesh(BoxShape{{1.0, 1.0, 1.0}});
  MassSettings settings;
  settings.mass = 100.0;
  const BodyMass light = body_mass(settings, mass_properties(mesh));
  settings.mass = 300.0;
  const BodyMass heavy = body_mass(settings, mass_properties(mesh));
  BodyState left, right;
  left.velocity = {2.0, 0.0, 0.0};
  right.position = {1.5, 0.0, 0.0};
  FreeBody a(left, light), b(right, heavy);
  BodyContacts contacts(0.1);
  const std::size_t hull_a = contacts.add_free(mesh, light);
  const std::size_t hull_b = contacts.add_free(mesh, heavy);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  for (int k = 0; k < 1000; ++k) {
    for (FreeBody* body : {&a, &b}) body->predict(1e-3, 0.0, FreeBody::Order::kDriftFirst);
    contacts.place_free(hull_a, a);
    contacts.place_free(hull_b, b);
    contacts.resolve(1e-3);
    a.take(zero, zero, contacts.velocity(hull_a), contacts.angular_velocity(hull_a));
    b.take(zero, zero, contacts.velocity(hull_b), contacts.angular_velocity(hull_b));
  }
  EXPECT_NEAR(a.velocity().x(), 0.5, 0.01) << "inelastic: both go on together";
  EXPECT_NEAR(b.velocity().x(), 0.5, 0.01);
  EXPECT_NEAR(100.0 * a.velocity().x() + 300.0 * b.velocity().x(), 200.0, 1e-9);
}

}  // namespace
}  // namespace pelagos
