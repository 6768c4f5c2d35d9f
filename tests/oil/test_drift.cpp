#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector2d drift_velocity(const SurfaceState& state, const SlickSettings& settings = plain_settings()) {
  SlickLayer layer(settings);
  release_disc(layer, 100.0, {0.0, 0.0}, 5.0, 20);
  const Eigen::Vector2d before = centre_of_mass(layer);
  run(layer, PlacedSurroundings(state), 100.0, 0.5);
  return (centre_of_mass(layer) - before) / 100.0;
}

TEST(Drift, IsThreePercentOfTheWindOverStillWater) {
  const Eigen::Vector2d velocity = drift_velocity(moving({0.0, 0.0}, {10.0, 0.0}));
  EXPECT_NEAR(velocity.x(), 0.30, 0.003);  // 1 %
  EXPECT_NEAR(velocity.y(), 0.0, 0.003);
}

TEST(Drift, AddsTheCurrent) {
  const Eigen::Vector2d velocity = drift_velocity(moving({0.0, 0.5}, {10.0, 0.0}));
  EXPECT_NEAR(velocity.x(), 0.30, 0.003);
  EXPECT_NEAR(velocity.y(), 0.50, 0.005);
}

TEST(Drift, TakesLessOfTheWindWhereWavesCarryTheOil) {
  SurfaceState state = moving({0.1, 0.0}, {0.0, -10.0});
  state.waves_carry = true;
  const Eigen::Vector2d velocity = drift_velocity(state);
  EXPECT_NEAR(velocity.x(), 0.1, 0.002);
  EXPECT_NEAR(velocity.y(), -0.2, 0.002);
}

TEST(Drift, SharesAreSettings) {
  SlickSettings settings = plain_settings();
  settings.wind_share = 0.035;
  EXPECT_NEAR(drift_velocity(moving({0.0, 0.0}, {10.0, 0.0}), settings).x(), 0.35, 0.0035);
}

TEST(Drift, FollowsAVortex) {
  SlickSettings settings = plain_settings();
  settings.terminal_thickness = 1.0;  // no spreading
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(1.0, {10.0, 0.0}, 0.5));
  const PlacedSurroundings vortex([](const Eigen::Vector2d& p) { return moving({-0.1 * p.y(), 0.1 * p.x()}); });
  run(layer, vortex, 5.0 * std::numbers::pi, std::numbers::pi / 1000.0);  // a quarter turn
  EXPECT_NEAR(layer.elements()[0].position.x(), 0.0, 0.02);
  EXPECT_NEAR(layer.elements()[0].position.y(), 10.0, 0.02);  // first order in the step
}

TEST(Drift, AnElementKeepsItsPlaceWhereTheSurroundingsAreNotFinite) {
  for (int field = 0; field < 4; ++field) {
    SlickLayer layer(plain_settings());
    ASSERT_FALSE(layer.release(1.0, {0.0, 0.0}, 1.0));
    ASSERT_FALSE(layer.release(1.0, {100.0, 0.0}, 1.0));
    const PlacedSurroundings partly([field](const Eigen::Vector2d& p) {
      SurfaceState state = moving({1.0, 0.0});
      if (p.x() > 50.0) {
        if (field == 0) state.water_velocity.x() = kNan;
        if (field == 1) state.wind.y() = std::numeric_limits<double>::infinity();
        if (field == 2) state.height = kNan;
        if (field == 3) state.way_out.x() = kNan;
      }
      return state;
    });
    const SlickReport report = layer.advance(1.0, partly);
    EXPECT_EQ(report.bad_surroundings, 1u);
    EXPECT_NEAR(layer.elements()[0].position.x(), 1.0, 1e-9);
    EXPECT_EQ(layer.elements()[1].position, Eigen::Vector2d(100.0, 0.0));
    for (const SlickElement& e : layer.elements()) EXPECT_TRUE(std::isfinite(e.film) && std::isfinite(e.size));
    EXPECT_EQ(layer.ledger().balance(), 0);
  }
}

TEST(Drift, OilLiesWhereItIsDry) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(1.0, {0.0, 0.0}, 1.0));
  SurfaceState dry = moving({1.0, 0.0});
  dry.water = false;
  const SlickReport report = layer.advance(1.0, PlacedSurroundings(dry));
  EXPECT_EQ(report.stranded, 1u);
  EXPECT_EQ(layer.elements()[0].position, Eigen::Vector2d(0.0, 0.0));
}

TEST(Drift, HullsPushOilOutAlongTheShortestWay) {
  // A round hull of 10 m that stands in a current: no oil stays under it, and none is lost.
  const PlacedSurroundings hull([](const Eigen::Vector2d& p) {
    SurfaceState state = moving({0.5, 0.0});
    const double distance = p.norm();
    if (distance < 10.0) {
      state.covered = true;
      state.way_out =
          distance > 0.0 ? Eigen::Vector2d(p / distance * (10.001 - distance)) : Eigen::Vector2d(10.001, 0.0);
    }
    return state;
  });
  SlickLayer layer(plain_settings());
  release_disc(layer, 50.0, {-30.0, 0.5}, 5.0, 50);
  std::size_t pushed = 0;
  for (int step = 0; step < 1000; ++step) pushed += layer.advance(0.2, hull).pushed_out;
  EXPECT_GT(pushed, 0u);
  for (const SlickElement& e : layer.elements()) EXPECT_GT(e.position.norm(), 9.8);
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(50.0));
}

TEST(Drift, OilThatLeavesThePatchIsCounted) {
  SlickSettings settings = plain_settings();
  settings.patch = SlickPatch{{-50.0, -50.0}, {50.0, 50.0}};
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(3.0, {45.0, 0.0}, 1.0));
  ASSERT_FALSE(layer.release(4.0, {-45.0, 0.0}, 1.0));
  run(layer, PlacedSurroundings(moving({1.0, 0.0})), 10.0, 1.0);
  EXPECT_EQ(layer.ledger().left_patch, to_milligrams(3.0));
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(4.0));
  EXPECT_EQ(layer.ledger().balance(), 0);
}

TEST(Drift, OilStopsAtClosedSidesOfThePatch) {
  SlickSettings settings = plain_settings();
  settings.patch = SlickPatch{{-50.0, -50.0}, {50.0, 50.0}, {true, false}};
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(3.0, {45.0, -10.0}, 1.0));
  run(layer, PlacedSurroundings(moving({1.0, 0.0})), 20.0, 1.0);
  EXPECT_EQ(layer.elements()[0].position, Eigen::Vector2d(50.0, -10.0)) << "straight on: it stops";
  run(layer, PlacedSurroundings(moving({1.0, 0.5})), 20.0, 1.0);
  EXPECT_EQ(layer.elements()[0].position, Eigen::Vector2d(50.0, 0.0)) << "at a slant: it goes along";
  EXPECT_EQ(layer.ledger().left_patch, 0);
  run(layer, PlacedSurroundings(moving({1.0, 1.0})), 60.0, 1.0);
  EXPECT_EQ(layer.ledger().left_patch, to_milligrams(3.0)) << "over the side that is open it leaves";
}

TEST(Drift, ALargeSlickInAClosedPatchLosesNothing) {
  // Spreading, splitting and a boom at the face, all of it at a wall and in a corner.
  SlickSettings settings = plain_settings();
  settings.patch = SlickPatch{{0.0, 0.0}, {40.0, 30.0}, {true, true}};
  settings.largest_radius = 3.0;
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.set_boom("b", Boom{{{30.0, -5.0}, {30.0, 35.0}}}));
  ASSERT_FALSE(layer.release(3000.0, {20.0, 15.0}, 2.0));
  run(layer, PlacedSurroundings(moving({1.0, 0.7})), 120.0, 0.5);
  EXPECT_EQ(layer.ledger().left_patch, 0);
  EXPECT_EQ(layer.ledger().balance(), 0);
  for (const SlickElement& e : layer.elements())
    EXPECT_TRUE(e.position.x() <= 40.0 && e.position.y() <= 30.0) << e.position.transpose();
}

TEST(Drift, AStepThatIsNoStepDoesNothing) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(1.0, {0.0, 0.0}, 1.0));
  for (const double dt : {0.0, -1.0, kNan, std::numeric_limits<double>::infinity()})
    layer.advance(dt, PlacedSurroundings(moving({1.0, 0.0})));
  EXPECT_EQ(layer.elements()[0].position, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(layer.elements()[0].age, 0.0);
}

TEST(Drift, AnEmptyLayerAdvances) {
  SlickLayer layer(plain_settings());
  EXPECT_EQ(layer.advance(1.0, PlacedSurroundings()).elements, 0u);
  EXPECT_EQ(layer.statistics().area, 0.0);
  EXPECT_TRUE(layer.frame().discs.empty());
  EXPECT_TRUE(layer.give_back().empty());
}

TEST(Drift, CarriesTheSurfaceHeightForDrawing) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(1.0, {0.0, 0.0}, 1.0));
  SurfaceState state;
  state.height = 2.5;
  layer.advance(0.1, PlacedSurroundings(state));
  EXPECT_FLOAT_EQ(layer.frame().discs[0].z, 2.5f);
}

}  // namespace
}  // namespace pelagos
