#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

Boom straight_boom() {
  Boom boom;
  boom.line = {{0.0, -50.0}, {0.0, 50.0}};
  return boom;
}

/// A pocket open against the current, which comes from -x.
Boom pocket() {
  Boom boom;
  boom.line = {{-30.0, -20.0}, {0.0, -10.0}, {0.0, 10.0}, {-30.0, 20.0}};
  return boom;
}

double mass_beyond(const SlickLayer& layer, double x) {
  double mass = 0.0;
  for (const SlickElement& e : layer.elements())
    if (e.position.x() > x) mass += to_kilograms(e.mass);
  return mass;
}

TEST(Booms, HoldOilBelowTheCriticalSpeed) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.set_boom("b", pocket()));
  release_disc(layer, 200.0, {-25.0, 0.0}, 3.0, 60);
  run(layer, PlacedSurroundings(moving({0.3, 0.0})), 300.0, 0.2);
  EXPECT_EQ(mass_beyond(layer, 0.0), 0.0);
  EXPECT_EQ(layer.ledger().balance(), 0);
  EXPECT_GT(to_kilograms(layer.ledger().contained), 190.0);
}

TEST(Booms, AreOpenAtTheirEnds) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.set_boom("b", straight_boom()));
  release_disc(layer, 1.0, {-10.0, 60.0}, 0.5, 5);
  run(layer, PlacedSurroundings(moving({0.3, 0.0})), 100.0, 0.2);
  EXPECT_GT(mass_beyond(layer, 0.0), 0.9);
}

TEST(Booms, LetOilSlideAlong) {
  // The boom lies at 45 degrees across the current: oil goes along it to its downstream end and leaves there.
  Boom boom;
  boom.line = {{0.0, 0.0}, {20.0, 20.0}};
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.set_boom("b", boom));
  ASSERT_FALSE(layer.release(0.1, {-2.0, 3.0}, 0.3));
  run(layer, PlacedSurroundings(moving({0.3, 0.0})), 60.0, 0.2);
  const Eigen::Vector2d halfway = centre_of_mass(layer);
  EXPECT_GT(halfway.y(), halfway.x());  // still on its side
  EXPECT_GT(halfway.y(), 6.0);          // and along: half the current's speed goes along a boom at 45 degrees
  run(layer, PlacedSurroundings(moving({0.3, 0.0})), 120.0, 0.2);
  EXPECT_GT(centre_of_mass(layer).x(), 21.0);
}

TEST(Booms, PileOilUpUntilItsWeightHoldsTheCurrent) {
  // Held oil stands against the current by g' h = U^2 (front Froude number 1).
  SlickSettings settings = plain_settings();
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.set_boom("b", pocket()));
  release_disc(layer, 5000.0, {-30.0, 0.0}, 8.0, 200);
  run(layer, PlacedSurroundings(moving({0.25, 0.0})), 600.0, 0.2);
  double film = 0.0, mass = 0.0;
  for (const SlickElement& e : layer.elements())
    if (e.contained) film += static_cast<double>(e.mass) * e.film, mass += static_cast<double>(e.mass);
  EXPECT_GT(mass, 4000e6);
  const double balance = 0.25 * 0.25 / reduced_gravity(settings);
  EXPECT_GT(film / mass, 0.5 * balance);
  EXPECT_LT(film / mass, 2.0 * balance);
}

double leaked_in_a_minute(double current, double entrainment = 1.0) {
  SlickLayer layer(plain_settings());
  Boom boom = pocket();
  boom.entrainment = entrainment;
  EXPECT_FALSE(layer.set_boom("b", boom));
  release_disc(layer, 2000.0, {-6.0, 0.0}, 5.0, 100);
  run(layer, PlacedSurroundings(moving({0.3, 0.0})), 120.0, 0.2);
  run(layer, PlacedSurroundings(moving({current, 0.0})), 60.0, 0.2);
  EXPECT_EQ(layer.ledger().balance(), 0);
  return mass_beyond(layer, 0.0);
}

TEST(Booms, LeakAboveTheCriticalSpeedAndMoreTheFasterTheWater) {
  EXPECT_EQ(leaked_in_a_minute(0.35), 0.0);
  const double slow = leaked_in_a_minute(0.40), fast = leaked_in_a_minute(0.60);
  EXPECT_GT(slow, 0.0);
  EXPECT_GT(fast, 2.0 * slow);
  EXPECT_EQ(leaked_in_a_minute(0.60, 0.0), 0.0);
}

TEST(Booms, LeakByTheStatedRate) {
  // One element alone at the boom, its film h over a footprint of area a: q h sqrt(a) with q = U - U_c.
  SlickSettings settings = plain_settings();
  settings.terminal_thickness = 1.0;
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.set_boom("b", straight_boom()));
  ASSERT_FALSE(layer.release(100.0, {-1.01, 0.0}, 2.0));
  const SlickElement before = layer.elements()[0];
  const double volume = 100.0 / settings.oil.density, footprint = std::sqrt(volume / before.film);
  const PlacedSurroundings current(moving({0.46, 0.0}));
  layer.advance(0.1, current);
  const double expected = 100.0 * (0.46 - 0.36) * 0.1 / footprint;
  double held = 0.0;
  for (const SlickElement& e : layer.elements())
    if (e.position.x() < 0.0) held += to_kilograms(e.mass);
  EXPECT_NEAR(100.0 - held, expected, 1e-5);
  EXPECT_EQ(to_kilograms(layer.ledger().contained), 100.0);  // on its way under the boom
}

TEST(Booms, DrainWhereOilIsDeeperThanTheSkirt) {
  SlickSettings settings = plain_settings();
  settings.terminal_thickness = 10.0;
  SlickLayer layer(settings);
  Boom boom = straight_boom();
  boom.draft = 0.05;
  ASSERT_FALSE(layer.set_boom("b", boom));
  const double area = std::numbers::pi;
  ASSERT_FALSE(layer.release(settings.oil.density * area * 0.2, {-0.51, 0.0}, 1.0));  // 20 cm of oil
  run(layer, PlacedSurroundings(moving({0.1, 0.0})), 2.0, 0.1);
  EXPECT_NEAR(layer.elements()[0].film, 0.05 * settings.water_density / settings.oil.density, 0.005);
  EXPECT_GT(mass_beyond(layer, 0.0), 0.0);
  EXPECT_EQ(layer.ledger().balance(), 0);
}

TEST(Booms, AClosedRingContainsAllInside) {
  Boom ring;
  for (int k = 0; k <= 24; ++k)
    ring.line.emplace_back(20.0 * std::cos(k % 24 * std::numbers::pi / 12.0),
                           20.0 * std::sin(k % 24 * std::numbers::pi / 12.0));
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.set_boom("ring", ring));
  release_disc(layer, 1000.0, {0.0, 0.0}, 5.0, 100);
  ASSERT_FALSE(layer.release(7.0, {40.0, 0.0}, 0.5));
  run(layer, PlacedSurroundings(), 300.0, 0.2);
  EXPECT_EQ(layer.ledger().contained, to_milligrams(1000.0));
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(7.0));
  layer.remove_boom("ring");
  EXPECT_EQ(layer.ledger().contained, 0);
  run(layer, PlacedSurroundings(), 300.0, 0.2);
  EXPECT_EQ(layer.ledger().balance(), 0);
  EXPECT_GT(layer.statistics().area, 1.5 * std::numbers::pi * 400.0);  // set free, it goes on spreading
}

TEST(Booms, NothingGetsThroughInAnyDirectionOrStep) {
  // No entrainment, a skirt too deep for drainage, water that turns about: whatever the step, oil stays in the ring.
  Boom ring;
  ring.line = {{-10.0, -10.0}, {10.0, -10.0}, {10.0, 10.0}, {-10.0, 10.0}, {-10.0, -10.0}};
  ring.entrainment = 0.0;
  ring.draft = 100.0;
  for (const double dt : {0.05, 0.5, 5.0}) {
    SlickLayer layer(plain_settings());
    ASSERT_FALSE(layer.set_boom("ring", ring));
    release_disc(layer, 50.0, {2.0, 1.0}, 3.0, 80);
    for (int step = 0; step < 400; ++step)
      layer.advance(dt, PlacedSurroundings(moving({1.5 * std::cos(0.3 * step), 1.5 * std::sin(0.3 * step)})));
    for (const SlickElement& e : layer.elements()) {
      EXPECT_LT(std::abs(e.position.x()), 10.0) << dt;
      EXPECT_LT(std::abs(e.position.y()), 10.0) << dt;
    }
    EXPECT_EQ(layer.ledger().balance(), 0);
  }
}

TEST(Booms, KeepSlicksApart) {
  // Oil on one side neither pushes nor swallows oil on the other.
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.set_boom("b", straight_boom()));
  ASSERT_FALSE(layer.release(1.0, {-0.6, 0.0}, 1.0));
  ASSERT_FALSE(layer.release(2.0, {0.6, 0.0}, 1.0));
  layer.advance(0.1, PlacedSurroundings());
  ASSERT_EQ(layer.elements().size(), 2u);
  EXPECT_EQ(layer.elements()[0].position, Eigen::Vector2d(-0.6, 0.0));
}

/// A zigzag of `points` points about the origin.
Boom zigzag(std::size_t points, double width) {
  Boom boom;
  for (std::size_t i = 0; i < points; ++i)
    boom.line.emplace_back(width * (static_cast<double>(i) / static_cast<double>(points) - 0.5),
                           (i % 2 == 0 ? -0.5 : 0.5) * width);
  return boom;
}

TEST(Booms, DoTheSameInWhateverOrderTheyAreSet) {
  // Setting, replacing and removing one boom must leave what setting the rest alone does.
  SlickLayer some(plain_settings()), all(plain_settings());
  ASSERT_FALSE(some.set_boom("a", zigzag(70, 30.0)));
  ASSERT_FALSE(some.set_boom("c", pocket()));
  for (const char* name : {"d", "b", "c", "0"}) ASSERT_FALSE(all.set_boom(name, straight_boom()));
  ASSERT_FALSE(all.set_boom("c", pocket()));
  ASSERT_FALSE(all.set_boom("a", zigzag(70, 30.0)));
  for (const char* name : {"0", "b", "d"}) all.remove_boom(name);
  for (SlickLayer* layer : {&some, &all}) {
    release_disc(*layer, 200.0, {-8.0, 0.0}, 3.0, 60);
    run(*layer, PlacedSurroundings(moving({0.5, 0.1})), 20.0, 0.2);
  }
  ASSERT_EQ(some.elements().size(), all.elements().size());
  for (std::size_t i = 0; i < some.elements().size(); ++i)
    EXPECT_EQ(some.elements()[i].position, all.elements()[i].position);
}

TEST(Booms, OfManyPointsHoldAsOneOfFewDoes) {
  // A straight boom of a thousand points, cut into stretches, and one of two.
  SlickLayer few(plain_settings()), many(plain_settings());
  Boom cut;
  for (int i = 0; i < 1000; ++i) cut.line.emplace_back(0.0, -50.0 + 0.1001 * i);
  ASSERT_FALSE(few.set_boom("b", Boom{{cut.line.front(), cut.line.back()}}));
  ASSERT_FALSE(many.set_boom("b", cut));
  for (SlickLayer* layer : {&few, &many}) {
    release_disc(*layer, 100.0, {-5.0, 0.0}, 2.0, 40);
    run(*layer, PlacedSurroundings(moving({0.3, 0.1})), 60.0, 0.2);
    EXPECT_EQ(mass_beyond(*layer, 0.0), 0.0);
  }
  EXPECT_LT((centre_of_mass(few) - centre_of_mass(many)).norm(), 0.01);
}

TEST(Booms, RefuseWhatIsNoBoom) {
  SlickLayer layer(plain_settings());
  const auto refusal = [&](auto change) {
    Boom boom = straight_boom();
    change(boom);
    return text_of(layer.set_boom("b", boom));
  };
  EXPECT_EQ(refusal([](Boom& b) { b.line.resize(1); }), "line: 1; allowed: 2 to 1000 points");
  EXPECT_EQ(refusal([](Boom& b) { b.draft = 0.0; }), "draft: 0; allowed: finite and above 0");
  EXPECT_EQ(refusal([](Boom& b) { b.critical_speed = -1.0; }), "critical_speed: -1; allowed: finite and above 0");
  EXPECT_EQ(refusal([](Boom& b) { b.entrainment = 11.0; }), "entrainment: 11; allowed: 0 to 10");
  EXPECT_EQ(refusal([](Boom& b) { b.line[1].x() = std::numeric_limits<double>::quiet_NaN(); }),
            "line[1].position.x: nan; allowed: -1e8 m to 1e8 m");
  EXPECT_EQ(refusal([](Boom& b) { b.line[1] = b.line[0]; }),
            "line: points 0 and 1 are 0 m apart; allowed: at least 0.1");
  EXPECT_TRUE(layer.state().booms.empty());
}

TEST(Booms, AreLeftAloneWhereAnotherNameIsRemoved) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.set_boom("b", straight_boom()));
  layer.remove_boom("c");
  EXPECT_EQ(layer.state().booms.size(), 1u);
}

}  // namespace
}  // namespace pelagos
