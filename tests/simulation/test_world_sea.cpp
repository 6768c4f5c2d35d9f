// The sea around the patch by systems: what a world makes of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fields/field_hash.hpp"
#include "give.hpp"
#include "same_run.hpp"
#include "small_patch.hpp"

namespace pelagos {

namespace {

using test::expect_same_run;
using test::small_patch;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;

SeaSettings sea_of(double height, double period = 6.0) {
  WaveSystem system;
  system.height = height;
  system.period = period;
  system.to_deg = 250.0;
  return {{system}, 60, {}, 0.0, {}};
}

Scene patch_in_a_sea() {
  Scene scene = small_patch();
  scene.far_sea.sea = sea_of(1.5);
  return scene;
}

double height_of(const World& world) { return 4.0 * std::sqrt(wave_variance(world.sea().components())); }

TEST(WorldSea, IsThatOfTheScene) {
  Scene scene = patch_in_a_sea();
  const World world(scene, {1, nullptr, {}});
  EXPECT_EQ(world.sea().components().size(), 60U);
  EXPECT_EQ(world.sea().level(), world.water_level());
  EXPECT_NEAR(height_of(world), 1.5, 1e-4);
  ASSERT_TRUE(world.sea_request().has_value());
  EXPECT_EQ(world.sea_request()->settings.seed, scene.seed) << "the scene's, and it is told";
  scene.seed += 1;
  const World other(scene, {1, nullptr, {}});
  EXPECT_NE(other.sea().components()[0].phase, world.sea().components()[0].phase);
}

TEST(WorldSea, ComesByACommandWithABlend) {
  World world(patch_in_a_sea(), {1, nullptr, {}});
  for (int n = 0; n < 3; ++n) world.advance();
  SetSea command{sea_of(0.8), 2.0};
  command.sea.seed = 77;
  command.sea.shortest_length = 20.0;
  ASSERT_EQ(test::give(world, command), std::nullopt);
  EXPECT_EQ(world.sea().layers().size(), 2U);
  EXPECT_EQ(world.sea().layers()[1].seconds, 2.0);
  EXPECT_EQ(world.sea_request()->settings.seed, 77U);
  const double left_out = world.sea_request()->left_out;
  EXPECT_GT(left_out, 0.1);
  EXPECT_NEAR(std::hypot(height_of(world), left_out), 0.8, 1e-4);
  ASSERT_EQ(test::give(world, (SetWaves{{}, 1.0})), std::nullopt);
  EXPECT_FALSE(world.sea_request().has_value()) << "waves one by one are no such sea";
}

TEST(WorldSea, GoesOnInTheMiddleOfABlendFromAFile) {
  expect_same_run(patch_in_a_sea(), 12, 24, [](World& world, std::uint64_t step) {
    if (step == 3) {
      ASSERT_EQ(test::give(world, (SetSea{sea_of(0.8), 0.8})), std::nullopt);
    }
    if (step == 18) {
      ASSERT_EQ(test::give(world, (SetSea{sea_of(0.4), 0.0})), std::nullopt);
    }
  });
}

TEST(WorldSea, AndItsRequestArePartOfTheState) {
  World one(patch_in_a_sea(), {1, nullptr, {}}), other(patch_in_a_sea(), {1, nullptr, {}});
  ASSERT_EQ(test::give(other, (SetSea{sea_of(0.8), 2.0})), std::nullopt);
  EXPECT_EQ(test::first_difference(one, other), "sea.layers.size: 1 and 2");
  one.restore(other.state());
  ASSERT_TRUE(one.sea_request().has_value());
  EXPECT_EQ(one.sea_request()->settings.systems[0].height, 0.8) << "so that the status can tell it";
}

/// A patch of 8 x 8 x 4 m with a wind whose sea grows a hundred times as fast as in nature.
Scene patch_in_a_wind() {
  Scene scene;
  scene.name = "wind sea";
  scene.particle_spacing = 1.0;
  scene.patch = {{0, 0, 0}, {8, 8, 8}};
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{{0, 0, 0}, {8, 8, 4}}};
  scene.wind.emplace();
  scene.wind->velocity = {12.0, 0.0, 0.0};
  scene.far_sea.sea.emplace();
  scene.far_sea.sea->components = 40;
  scene.far_sea.sea->wind_sea = WindSeaSettings{100e3, 3600.0, 100.0};
  return scene;
}

TEST(WorldSea, GrowsWithTheWind) {
  World world(patch_in_a_wind(), {1, nullptr, {}});
  const SteadyWind wind{12.0, 90.0};
  const WindSeaSettings& settings = *world.scene().far_sea.sea->wind_sea;
  WindSea expected = start_wind_sea(settings, wind, kStandardGravity);
  EXPECT_NEAR(height_of(world), expected.height, 1e-3);
  EXPECT_NEAR(world.sea_request()->settings.systems.at(0).to_deg, 90.0, 1e-9);
  int renewals = 0;
  while (world.time() < 31.0) {
    const bool renewed = world.advance({}).sea_renewed;
    EXPECT_EQ(renewed, world.sea().layers().size() == 2U && renewals == 0);
    renewals += renewed ? 1 : 0;
  }
  EXPECT_EQ(renewals, 1);
  expected = wind_sea_after(expected, settings, wind, 30.0, kStandardGravity);
  EXPECT_NEAR(height_of(world), expected.height, 0.03 * expected.height) << "it may lag by a second of 30";
  EXPECT_GT(expected.height, 1.2 * start_wind_sea(settings, wind, kStandardGravity).height);
}

TEST(WorldSea, KeepsTheBlendOfTheCommandThatLetsItGrow) {
  Scene scene = patch_in_a_wind();
  scene.far_sea.sea.reset();
  World world(scene, {1, nullptr, {}});
  SeaSettings grown;
  grown.components = 40;
  grown.wind_sea = WindSeaSettings{100e3, 600.0, 100.0};
  ASSERT_EQ(test::give(world, (SetSea{grown, 45.0})), std::nullopt);
  int renewals = 0;
  while (world.time() < 44.0) renewals += world.advance({}).sea_renewed ? 1 : 0;
  EXPECT_EQ(renewals, 0) << "the blend takes 45 s";
  while (world.time() < 46.0) renewals += world.advance({}).sea_renewed ? 1 : 0;
  EXPECT_EQ(renewals, 1);
}

TEST(WorldSea, GrowsOnFromAFile) {
  Scene scene = patch_in_a_wind();
  scene.far_sea.sea->wind_sea->blown_for.reset();
  World one(scene, {1, nullptr, {}}), other(scene, {1, nullptr, {}});
  SeaSettings grown = *scene.far_sea.sea;
  ASSERT_EQ(test::give(other, (SetSea{grown, 0.0})), std::nullopt);
  EXPECT_NEAR(height_of(other), height_of(one), 1e-6) << "a sea that grows goes on as it is";
  grown.wind_sea->blown_for = 600.0;
  ASSERT_EQ(test::give(other, (SetSea{grown, 0.0})), std::nullopt);
  EXPECT_LT(height_of(other), 0.7 * height_of(one));
  one.restore(other.state());
  while (one.time() < 30.5) {
    (void)one.advance({});
    (void)other.advance({});
  }
  EXPECT_EQ(test::first_difference(one, other), "");
  ASSERT_EQ(test::give(one, (SetWaves{{}, 0.0})), std::nullopt);
  while (one.time() < 61.0) (void)one.advance({});
  EXPECT_TRUE(one.sea().components().empty()) << "other waves end its growth";
}

TEST(WorldSea, IsRefusedWithTheValueAndWhatIsAllowed) {
  World world(patch_in_a_sea(), {1, nullptr, {}});
  const auto expect_refused = [&](const SetSea& command, const auto& why) {
    const std::uint64_t before = hash_fields(world.state());
    EXPECT_THAT(test::give(world, command), Optional(why));
    EXPECT_EQ(hash_fields(world.state()), before) << "nothing has changed";
  };
  expect_refused({sea_of(9.0), 5.0}, AllOf(HasSubstr("system[0].height: 9 m is too steep for a peak period of 6 s"),
                                           HasSubstr("allowed: at most 3.747 m")));
  for (int n = 1; n <= 7; ++n) ASSERT_EQ(test::give(world, (SetSea{sea_of(1.0), 8.0 - n})), std::nullopt);
  expect_refused({sea_of(1.0), 1.0}, AllOf(HasSubstr("allowed: 7 changes at a time"), HasSubstr("can begin at 1.0 s")));
}

}  // namespace

}  // namespace pelagos
