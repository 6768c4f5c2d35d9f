// Oil that cannot flow out, and oil in a world whose last good state comes back.

#include <gmock/gmock.h>

#include <limits>

#include "give.hpp"
#include "oily_patch.hpp"
#include "values/oil_limits.hpp"
#include "world_access.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;
using testing::Optional;

ReleaseOil source_at(double x, double y, double z) {
  ReleaseOil source;
  source.name = "leak";
  source.from = source.to = {x, y, z};
  source.rate = 360.0;  // 0.1 m^3/s
  return source;
}

TEST(OilWaits, InTheAirAndIsCountedWhenTheSourceEnds) {
  World world(test::oily_patch(OilModel::kParticles), {1, nullptr, {}});
  ReleaseOil high = source_at(2.5, 2.0, 2.9);  // farther above the water than oil falls: four spacings
  high.duration = 2.0;
  ASSERT_EQ(test::give(world, OilCommand{high}), std::nullopt);
  test::run_with_ledger(world, 1.9);
  ASSERT_EQ(test::budget_of(world).sources.size(), 1U);
  const SourceStatus source = test::budget_of(world).sources[0];
  EXPECT_EQ(source.name, "leak");
  EXPECT_EQ(source.wait, SourceWait::kNoWater);
  EXPECT_NEAR(source.waiting, 1.9 - test::kParticleVolume / 0.1, 0.05) << "since the first particle was due";
  EXPECT_NEAR(source.pending, 0.19 * test::kOilDensity, 1.0);
  test::run_with_ledger(world, 2.1);
  EXPECT_TRUE(test::budget_of(world).sources.empty());
  EXPECT_EQ(test::budget_of(world).ledger.released, 0);
  EXPECT_NEAR(test::budget_of(world).held_back, 0.2 * test::kOilDensity, 1e-6);
}

TEST(OilWaits, AtTheBoundOnParticles) {
  Scene scene = test::oily_patch(OilModel::kParticles);
  scene.oil->most_particles = 3;
  World world(scene, {1, nullptr, {}});
  ASSERT_EQ(test::give(world, OilCommand{source_at(2.5, 2.0, 0.5)}), std::nullopt);
  test::run_with_ledger(world, 0.4);
  EXPECT_EQ(test::budget_of(world).sources[0].wait, SourceWait::kNone);
  test::run_with_ledger(world, 1.0);
  EXPECT_EQ(test::budget_of(world).particles, 3U);
  EXPECT_EQ(test::budget_of(world).sources[0].wait, SourceWait::kFull);
}

TEST(OilWaits, NotAtTheBoundWhereThereIsAFilm) {
  Scene scene = test::oily_patch(OilModel::kBoth);
  scene.oil->most_particles = 3;
  World world(scene, {1, nullptr, {}});
  ASSERT_EQ(test::give(world, OilCommand{source_at(2.5, 2.0, 0.5)}), std::nullopt);
  while (world.time() < 2.0) {
    test::run_with_ledger(world, world.time() + 0.05);
    EXPECT_EQ(test::budget_of(world).sources[0].waiting, 0.0);
  }
  EXPECT_GT(test::budget_of(world).ledger.afloat, 0);
}

TEST(OilWaits, OnDryGroundUntilTheWaterComes) {
  Scene scene = test::small_patch();
  scene.patch.max.x() = 10.0;
  scene.water.settle_steps = 0;  // 5 m of water begin to run out over 5 m of dry floor
  World world(test::oily_patch(OilModel::kSlick, scene), {1, nullptr, {}});
  ASSERT_EQ(test::give(world, OilCommand{source_at(9.5, 2.0, 0.2)}), std::nullopt);
  test::run_with_ledger(world, 0.6);
  EXPECT_EQ(test::budget_of(world).sources[0].wait, SourceWait::kNoWater);
  EXPECT_EQ(test::budget_of(world).ledger.released, 0);
  test::run_with_ledger(world, 4.0);
  EXPECT_EQ(test::budget_of(world).sources[0].wait, SourceWait::kNone);
  EXPECT_GT(to_kilograms(test::budget_of(world).ledger.released), 0.3 * test::kOilDensity) << "what waited came too";
}

TEST(OilWaits, ASourceThatIsStoppedBringsOutWhatHasFlowed) {
  World world(test::oily_patch(OilModel::kSlick), {1, nullptr, {}});
  ASSERT_EQ(test::give(world, OilCommand{source_at(2.5, 2.0, 0.5)}), std::nullopt);
  test::run_with_ledger(world, 0.8);
  const double time = world.time();
  ASSERT_EQ(test::give(world, OilCommand{StopRelease{"leak"}}), std::nullopt);
  EXPECT_THAT(test::give(world, OilCommand{StopRelease{"leak"}}), Optional(HasSubstr("no source \"leak\" is running")));
  test::run_with_ledger(world, 1.5);
  EXPECT_NEAR(to_kilograms(test::budget_of(world).ledger.released), 0.1 * time * test::kOilDensity, 1e-3);
  EXPECT_EQ(test::budget_of(world).held_back, 0.0);
  EXPECT_TRUE(test::budget_of(world).sources.empty());
}

TEST(OilWaits, NotForOneSourceTooMany) {
  World world(test::oily_patch(OilModel::kSlick), {1, nullptr, {}});
  ReleaseOil source = source_at(2.5, 2.0, 0.5);
  for (std::size_t i = 0; i < kMostReleases; ++i) {
    source.name = "source " + std::to_string(i);
    ASSERT_EQ(test::give(world, OilCommand{source}), std::nullopt);
  }
  EXPECT_EQ(test::give(world, OilCommand{source}), std::nullopt) << "in the place of the one of that name";
  source.name = "more";
  EXPECT_THAT(test::give(world, OilCommand{source}),
              Optional(HasSubstr("100 sources are running; allowed: at most 100")));
}

TEST(OilWaits, NotInAHullThatIsNoWiderThanItsReach) {
  const test::CubeFile cube;
  World world(test::oily_patch(OilModel::kParticles, test::patch_with_cube(cube)), {1, nullptr, {}});
  EXPECT_THAT(test::give(world, OilCommand{source_at(2.5, 2.0, 0.9)}),
              Optional(HasSubstr("from: (2.5, 2, 0.9) m is inside a hull")));
  ReleaseOil breach = source_at(0.0, 0.0, -0.2);
  breach.body = 1;
  ASSERT_EQ(test::give(world, OilCommand{breach}), std::nullopt);
  test::run_with_ledger(world, 1.0);
  EXPECT_GT(test::budget_of(world).particles, 0U) << "it comes out beside the cube";
}

/// Oil in all its places: particles, film, held by a boom, skimmed, on its way out of two sources.
World busy_world() {
  Scene scene = test::oily_patch(OilModel::kBoth);
  scene.on_fault = FaultPolicy::kRestore;
  scene.oil->evaporation = scene.oil->emulsification = true;
  World world(scene, {1, nullptr, {}});
  ReleaseOil deep = source_at(2.5, 2.0, 0.4), high = source_at(1.0, 1.0, 2.9);
  high.name = "high";
  for (const OilCommand& command : std::initializer_list<OilCommand>{
           deep, high, SpillOil{{3.5, 2.0}, 0.05, 0.5}, SetBoom{"boom", {{4.0, 1.0}, {4.0, 3.0}}, 0.5, 0.36},
           SetSkimmer{"rig", {3.5, 2.0}, 0.5, 20.0}})
    EXPECT_EQ(test::give(world, command), std::nullopt);
  test::run_with_ledger(world, 1.5);
  return world;
}

void expect_same(const std::vector<SlickDisc>& a, const std::vector<SlickDisc>& b) {
  ASSERT_EQ(a.size(), b.size());
  const auto values = [](const SlickDisc& d) {
    return std::array{d.x, d.y, d.z, d.radius, d.thickness, d.mass, d.water, d.contained ? 1.0F : 0.0F};
  };
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(values(a[i]), values(b[i])) << i;
}

void expect_same(const OilBudget& a, const OilBudget& b) {
  EXPECT_EQ(a.ledger, b.ledger);
  EXPECT_EQ(a.particles, b.particles);
  EXPECT_EQ(a.displaced_water, b.displaced_water);
  EXPECT_EQ(a.held_back, b.held_back);
  EXPECT_EQ(a.emulsion_water, b.emulsion_water);
  ASSERT_EQ(a.sources.size(), b.sources.size());
  for (std::size_t i = 0; i < a.sources.size(); ++i) {
    EXPECT_EQ(a.sources[i].pending, b.sources[i].pending);
    EXPECT_EQ(a.sources[i].waiting, b.sources[i].waiting);
  }
  ASSERT_EQ(a.skimmers.size(), b.skimmers.size());
  for (std::size_t i = 0; i < a.skimmers.size(); ++i) EXPECT_EQ(a.skimmers[i].recovered, b.skimmers[i].recovered);
}

void break_a_particle(World& world) {
  WorldTestAccess::fluid(world).particles.velocity[200].x = std::numeric_limits<float>::quiet_NaN();
}

TEST(OilRestored, IsAsItWasBeforeTheFault) {
  World world = busy_world();
  const OilBudget before = test::budget_of(world);
  EXPECT_GT(before.ledger.submerged, 0);
  EXPECT_GT(before.ledger.afloat + before.ledger.contained, 0);
  EXPECT_GT(before.ledger.recovered, 0);
  const std::vector<SlickDisc> discs = world.spill()->discs();
  const std::vector<std::uint8_t> phase = world.fluid().particles.phase;
  break_a_particle(world);
  ASSERT_EQ(world.advance().fault, StepFault::kRestored);
  expect_same(test::budget_of(world), before);
  expect_same(world.spill()->discs(), discs);
  EXPECT_EQ(world.fluid().particles.phase, phase);
  EXPECT_EQ(test::budget_of(world).ledger.balance(), 0);
  test::run_with_ledger(world, 3.0);  // the ledger closes in every step
  EXPECT_GT(test::budget_of(world).ledger.released, before.ledger.released);
}

TEST(OilRestored, KeepsWhatWasOrderedSinceTheLastStep) {
  World world = busy_world();
  ASSERT_EQ(test::give(world, OilCommand{SetBoom{"late", {{1.0, 1.0}, {1.0, 3.0}}, 0.5, 0.36}}), std::nullopt);
  ASSERT_EQ(test::give(world, OilCommand{RemoveSkimmer{"rig"}}), std::nullopt);
  ASSERT_EQ(test::give(world, OilCommand{SpillOil{{2.0, 2.0}, 0.01, 0.3}}), std::nullopt);
  const OilBudget ordered = test::budget_of(world);
  break_a_particle(world);
  ASSERT_EQ(world.advance().fault, StepFault::kRestored);
  expect_same(test::budget_of(world), ordered);
  EXPECT_TRUE(test::budget_of(world).skimmers.empty());
  EXPECT_EQ(test::give(world, OilCommand{RemoveBoom{"late"}}), std::nullopt) << "its event has been told";
  test::run_with_ledger(world, world.time() + 0.5);
}

}  // namespace
}  // namespace pelagos
