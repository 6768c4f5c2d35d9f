#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "give.hpp"
#include "oily_patch.hpp"
#include "simulation/world.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;
using testing::Optional;

World make_world(const Scene& scene, int threads = 1) { return World(scene, {threads, nullptr, {}}); }

ReleaseOil leak() {
  ReleaseOil leak;
  leak.name = "leak";
  leak.from = leak.to = {2.5, 2.0, 0.5};
  leak.rate = 1800.0;  // half a cubic metre a second: 32 particles
  leak.duration = 1.0;
  return leak;
}

double largest_density(World& world, double time) {
  double largest = 0.0;
  while (world.time() < time - 1e-9) largest = std::max(largest, world.advance().report.largest_density);
  return largest;
}

TEST(OilSpill, ASourceBringsItsRateForItsTime) {
  World world = make_world(test::oily_patch(OilModel::kParticles));
  EXPECT_EQ(test::give(world, OilCommand{leak()}), std::nullopt);
  test::run_with_ledger(world, 2.0);
  const OilBudget oil = test::budget_of(world);
  EXPECT_EQ(oil.particles, 32U);
  EXPECT_NEAR(to_kilograms(oil.ledger.submerged), 0.5 * test::kOilDensity, 0.05);
  EXPECT_EQ(oil.ledger.released, oil.ledger.submerged);
  EXPECT_NEAR(oil.displaced_water, 0.5 * 1000.0, 1e-6);
  EXPECT_NEAR(oil.held_back, 0.0, test::kParticleVolume * test::kOilDensity) << "less than a particle";
}

TEST(OilSpill, MakesNoPressureSpike) {
  World with = make_world(test::oily_patch(OilModel::kParticles)),
        without = make_world(test::oily_patch(OilModel::kParticles));
  ASSERT_EQ(test::give(with, OilCommand{leak()}), std::nullopt);
  EXPECT_LT(largest_density(with, 1.0), largest_density(without, 1.0) + 0.03);
}

TEST(OilSpill, FilmTakesWhatTheSlickModelReleases) {
  World world = make_world(test::oily_patch(OilModel::kSlick));
  ASSERT_EQ(test::give(world, OilCommand{leak()}), std::nullopt);
  test::run_with_ledger(world, 2.0);
  const OilBudget oil = test::budget_of(world);
  EXPECT_EQ(oil.particles, 0U);
  EXPECT_GT(oil.elements, 0U);
  EXPECT_GT(oil.area, 0.0);
  EXPECT_NEAR(to_kilograms(oil.ledger.released), 0.5 * test::kOilDensity, 1e-3);
  EXPECT_EQ(oil.displaced_water, 0.0);
}

TEST(OilSpill, OilGoesBetweenParticlesAndFilm) {
  World world = make_world(test::oily_patch(OilModel::kBoth));
  ReleaseOil thin = leak();
  thin.from = thin.to = {2.5, 2.0, 1.1};             // near the surface
  thin.rate = 3600.0 * 2.0 * test::kParticleVolume;  // two particles a second: never a layer
  ASSERT_EQ(test::give(world, OilCommand{thin}), std::nullopt);
  test::run_with_ledger(world, 3.0);
  EXPECT_GT(test::budget_of(world).ledger.afloat, 0) << "lone particles became film";
  EXPECT_EQ(test::budget_of(world).ledger.released, 2 * to_milligrams(test::kParticleVolume * test::kOilDensity));
}

TEST(OilSpill, SkimmerRecoversAndTellsWhenItIsDry) {
  World world = make_world(test::oily_patch(OilModel::kSlick));
  ASSERT_EQ(test::give(world, OilCommand{SetSkimmer{"rig", {2.5, 2.0}, 1.0, 500.0}}), std::nullopt);
  ASSERT_EQ(test::give(world, OilCommand{SpillOil{{2.5, 2.0}, 0.05, 0.4}}), std::nullopt);
  test::run_with_ledger(world, 1.0);
  ASSERT_EQ(test::budget_of(world).skimmers.size(), 1U);
  EXPECT_EQ(test::budget_of(world).skimmers[0].name, "rig");
  EXPECT_GT(test::budget_of(world).ledger.recovered, 0);
  EXPECT_EQ(test::budget_of(world).ledger.recovered, test::budget_of(world).skimmers[0].recovered);
  ASSERT_EQ(test::give(world, OilCommand{SetSkimmer{"far", {0.5, 0.5}, 0.1, 500.0}}), std::nullopt);
  test::run_with_ledger(world, 1.2);
  EXPECT_TRUE(test::budget_of(world).skimmers[0].dry) << "far, by name first, on dry water";
}

TEST(OilSpill, DriftsWithACurrentThatThePatchCannotFollow) {
  Scene scene = test::oily_patch(OilModel::kSlick);
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  World world = make_world(scene);
  ASSERT_EQ(test::give(world, OilCommand{SpillOil{{1.5, 2.0}, 0.01, 0.3}}), std::nullopt);
  SetCurrent current;
  current.current.velocity = {0.5, 0.0, 0.0};
  ASSERT_EQ(test::give(world, current), std::nullopt);
  test::run_with_ledger(world, 3.0);
  double x = 0.0, mass = 0.0;
  for (const SlickDisc& disc : world.spill()->discs()) {
    x += static_cast<double>(disc.mass) * static_cast<double>(disc.x);
    mass += static_cast<double>(disc.mass);
  }
  EXPECT_NEAR(x / mass, 1.5 + 0.5 * 3.0, 0.25) << "the patch's own motion moves it besides";
}

/// Under the wind law that raises a sea at once the water itself runs far faster than 3 % of the wind.
TEST(OilSpill, DriftsWithThreeHundredthsOfTheWindUnderEveryLaw) {
  for (const WindLaw law : {WindLaw::kGust, WindLaw::kStress}) {
    SCOPED_TRACE(static_cast<int>(law));
    Scene scene = test::oily_patch(OilModel::kSlick);
    scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kMirror, PatchEdge::kMirror};
    scene.wind.emplace();
    scene.wind->law = law;
    scene.wind->velocity = {10.0, 0.0, 0.0};
    scene.wind->amplitude = 0.0;
    World world = make_world(scene);
    ASSERT_EQ(test::give(world, OilCommand{SpillOil{{1.0, 2.0}, 0.001, 0.1}}), std::nullopt);
    test::run_with_ledger(world, 3.0);
    double x = 0.0, mass = 0.0;
    for (const SlickDisc& disc : world.spill()->discs()) {
      x += static_cast<double>(disc.mass) * static_cast<double>(disc.x);
      mass += static_cast<double>(disc.mass);
    }
    ASSERT_GT(mass, 0.0);
    EXPECT_NEAR((x / mass - 1.0) / 3.0, 0.03 * 10.0, 0.15) << "m/s";
  }
}

/// Places of the slick's elements.
std::vector<Eigen::Vector2d> places_of(const World& world) {
  std::vector<Eigen::Vector2d> places;
  for (const SlickDisc& disc : world.spill()->discs())
    places.emplace_back(static_cast<double>(disc.x), static_cast<double>(disc.y));
  return places;
}

TEST(OilSpill, ACurrentStraightOnToAQuayEndsThere) {
  Scene scene = test::oily_patch(OilModel::kSlick);
  scene.current.emplace();
  scene.current->velocity = {0.6, 0.0, 0.0};
  BodySettings quay;
  quay.id = 1;
  quay.primitive = BoxShape{{0.5, 8.0, 4.0}};
  quay.drive = BodyDrive::kStatic;
  quay.position = {3.75, 2.0, 1.0};  // its face at x = 3.5
  scene.bodies = {quay};
  World world = make_world(scene);
  ASSERT_EQ(test::give(world, OilCommand{SpillOil{{2.5, 2.0}, 1e-5, 0.1}}), std::nullopt);
  test::run_with_ledger(world, 4.0);
  for (const Eigen::Vector2d& place : places_of(world)) {
    EXPECT_NEAR(place.x(), 3.5 - 0.25 * 0.25, 0.02);  // it keeps a quarter of a spacing
    // What is left is the water's own motion there; a search for a way out would carry it along with 0.4 m/s.
    EXPECT_NEAR(place.y(), 2.0, 0.25);
  }
  EXPECT_EQ(test::budget_of(world).ledger.left_patch, 0);
}

TEST(OilSpill, NeverLeavesAClosedPatch) {
  Scene scene = test::oily_patch(OilModel::kSlick);
  scene.current.emplace();
  scene.current->velocity = {1.0, 0.6, 0.0};
  World world = make_world(scene);
  ASSERT_EQ(test::give(world, OilCommand{SpillOil{{3.0, 2.5}, 0.01, 0.5}}), std::nullopt);
  test::run_with_ledger(world, 4.0);
  EXPECT_EQ(test::budget_of(world).ledger.left_patch, 0);
  const std::vector<Eigen::Vector2d> places = places_of(world);
  ASSERT_FALSE(places.empty());
  for (const Eigen::Vector2d& place : places) EXPECT_TRUE(place.x() <= 5.0 && place.y() <= 4.0) << place.transpose();
}

TEST(OilSpill, AHullThatMovesPushesOilBeforeIt) {
  Scene scene = test::oily_patch(OilModel::kSlick);
  BodySettings hull;
  hull.id = 1;
  hull.primitive = BoxShape{{1.0, 1.5, 1.0}};
  hull.position = {1.2, 2.0, 1.3};
  scene.bodies = {hull};
  World world = make_world(scene);
  ASSERT_EQ(test::give(world, OilCommand{SpillOil{{2.0, 2.0}, 1e-4, 0.2}}), std::nullopt);
  while (world.time() < 2.0) {
    BodyPose pose;
    pose.body = 1;
    pose.time = world.time() + 1.0;
    pose.position = hull.position + Eigen::Vector3d(0.6 * world.time(), 0, 0);
    pose.velocity = {0.6, 0, 0};
    test::give(world, pose);
    world.advance();
    const Eigen::Vector3d middle = world.bodies().states()[0].position;
    for (const Eigen::Vector2d& place : places_of(world)) {
      const Eigen::Vector2d off = (place - middle.head<2>()).cwiseAbs();
      // A step of the hull may lie between its last way out and this look.
      EXPECT_TRUE(off.x() > 0.48 || off.y() > 0.73) << place.transpose() << " at " << world.time() << " s";
    }
  }
  EXPECT_EQ(test::budget_of(world).ledger.left_patch, 0);
}

/// 278 cubic metres a second into a patch of 25: the film takes what finds no room, and no step takes minutes.
TEST(OilSpill, AFloodOfOilEndsInTheFilm) {
  Scene scene = test::oily_patch(OilModel::kBoth);
  World world = make_world(scene);
  ReleaseOil flood = leak();
  flood.rate = 1e6;
  flood.duration = 2.0;
  ASSERT_EQ(test::give(world, OilCommand{flood}), std::nullopt);
  test::run_with_ledger(world, 2.5);
  const OilBudget budget = test::budget_of(world);
  EXPECT_NEAR(to_kilograms(budget.ledger.released), 555.6 * test::kOilDensity, 0.01 * 555.6 * test::kOilDensity);
  EXPECT_EQ(budget.held_back, 0.0);
}

TEST(OilSpill, TheSameBitsForAnyNumberOfThreads) {
  std::uint64_t hash = 0;
  OilLedger ledger;
  for (const int threads : {1, 3}) {
    World world = make_world(test::oily_patch(OilModel::kBoth), threads);
    ASSERT_EQ(test::give(world, OilCommand{leak()}), std::nullopt);
    test::run_with_ledger(world, 1.5);
    if (threads == 1) {
      hash = state_hash(world.fluid().particles);
      ledger = test::budget_of(world).ledger;
    } else {
      EXPECT_EQ(state_hash(world.fluid().particles), hash);
      EXPECT_EQ(test::budget_of(world).ledger, ledger);
    }
  }
}

TEST(OilSpill, RefusesWhatCannotBe) {
  World dry = make_world(test::small_patch());
  EXPECT_THAT(test::give(dry, OilCommand{leak()}), Optional(HasSubstr("the scene has no oil")));

  World world = make_world(test::oily_patch(OilModel::kParticles));
  ReleaseOil wrong = leak();
  wrong.from.x() = 7.0;
  EXPECT_THAT(test::give(world, OilCommand{wrong}),
              Optional(AllOf(HasSubstr("from: (7, 2, 0.5) m is outside the patch"),
                             HasSubstr("allowed: (0, 0, 0) to (5, 4, 3)"))));
  wrong = leak();
  wrong.body = 9;
  EXPECT_THAT(test::give(world, OilCommand{wrong}), Optional(HasSubstr("body: the scene has no body 9")));
  wrong = leak();
  wrong.duration = 1000.0;
  EXPECT_THAT(test::give(world, OilCommand{wrong}), Optional(HasSubstr("oil.most_particles 400")));
  EXPECT_THAT(test::give(world, OilCommand{StopRelease{"no"}}), Optional(HasSubstr("name: there is no source \"no\"")));
  EXPECT_THAT(test::give(world, OilCommand{SetBoom{"b", {{1, 1}, {2, 2}}, 0.5, 0.36}}),
              Optional(HasSubstr("allowed with oil.model SLICK or BOTH")));
  EXPECT_THAT(test::give(world, OilCommand{SpillOil{{1, 1}, 1.0, 1.0}}), Optional(HasSubstr("slick layer")));
  EXPECT_THAT(test::give(world, OilCommand{RemoveBoom{"b"}}), Optional(HasSubstr("b")));
  EXPECT_TRUE(world.spill()->empty());
}

TEST(OilSpill, ASourceWithoutAnEndStopsAtTheBound) {
  Scene scene = test::oily_patch(OilModel::kParticles);
  scene.oil->most_particles = 10;
  World world = make_world(scene);
  ReleaseOil endless = leak();
  endless.duration = INFINITY;
  ASSERT_EQ(test::give(world, OilCommand{endless}), std::nullopt);
  test::run_with_ledger(world, 1.0);
  EXPECT_EQ(test::budget_of(world).particles, 10U);
  EXPECT_EQ(test::give(world, OilCommand{StopRelease{"leak"}}), std::nullopt);
}

TEST(OilSpill, NoOilNoCost) {
  static std::int64_t tick = 0;
  World world(test::small_patch(), {1, [] { return ++tick; }, {}});
  EXPECT_EQ(world.advance().report.times.ns[static_cast<std::size_t>(Stage::kOil)], 0);
  EXPECT_FALSE(world.spill());
}

}  // namespace
}  // namespace pelagos
