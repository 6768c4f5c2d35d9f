// The waves around the patch, exchanged while the world runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fields/field_hash.hpp"
#include "give.hpp"
#include "same_run.hpp"
#include "small_patch.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {

namespace {

using test::expect_same_run;
using test::small_patch;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;

Scene patch_in_a_sea() {
  Scene scene = small_patch();
  scene.far_sea = {4, 60.0, 24};
  return scene;
}

SetWaves swell(double blend, double amplitude = 0.8) {
  return {{{amplitude, 40.0, 0.0, 250.0, 30.0}, {0.2, 0.0, 3.0, 200.0, 0.0}}, blend};
}

float elevation_of(const World& world) {
  return surface_at(world.sea().at(world.time(), {0, 0}), 30.0F, -7.0F).elevation;
}

TEST(WorldWaves, AreThoseOfTheScene) {
  Scene scene = small_patch();
  scene.far_sea.waves = swell(0.0).waves;
  const World world(scene, {1, nullptr, {}});
  ASSERT_EQ(world.sea().components().size(), 2U);
  EXPECT_FLOAT_EQ(world.sea().components()[0].amplitude, 0.8F);
  EXPECT_EQ(world.sea().level(), world.water_level());
}

TEST(WorldWaves, BlendWithoutAJumpIntoThoseOfTheCommand) {
  World world(patch_in_a_sea(), {1, nullptr, {}});
  for (int n = 0; n < 3; ++n) world.advance();
  const double start = world.time();
  ASSERT_EQ(test::give(world, swell(0.5)), std::nullopt);
  float last = elevation_of(world);
  while (world.time() < start + 0.6) {
    const double before = world.time();
    world.advance();
    const float now = elevation_of(world);
    // Seas of 1 m height and periods above a second rise by a few m/s at most; a jump would be tenths of a metre.
    EXPECT_LT(std::abs(now - last), 6.0F * static_cast<float>(world.time() - before) + 1e-4F) << world.time();
    last = now;
  }
  EXPECT_EQ(world.sea().at(world.time(), {0, 0}).waves.size(), 2U) << "all of the old sea is gone";
  EXPECT_EQ(sea_status(world.sea(), world.time()).earlier, 0U);
  const SeaStatus half = sea_status(world.sea(), start + 0.25);
  EXPECT_DOUBLE_EQ(half.share, 0.5);
  EXPECT_NEAR(half.blend_left, 0.25, 1e-12);
  EXPECT_EQ(half.earlier, 1U);
  EXPECT_EQ(half.waves, 2U);
}

TEST(WorldWaves, OfASecondCommandComeWhileTheFirstStillBlends) {
  World world(patch_in_a_sea(), {1, nullptr, {}});
  ASSERT_EQ(test::give(world, swell(2.0)), std::nullopt);
  for (int n = 0; n < 5; ++n) world.advance();
  const float before = elevation_of(world);
  ASSERT_EQ(test::give(world, (SetWaves{{}, 1.0})), std::nullopt);
  EXPECT_EQ(elevation_of(world), before);
  EXPECT_EQ(world.sea().layers().size(), 3U);
  EXPECT_TRUE(world.sea().components().empty()) << "a flat sea to come";
}

TEST(WorldWaves, GoOnInTheMiddleOfABlendFromAFile) {
  expect_same_run(patch_in_a_sea(), 12, 30, [](World& world, std::uint64_t step) {
    if (step == 3) {
      ASSERT_EQ(test::give(world, swell(0.8)), std::nullopt);
    }
    if (step == 8) {
      ASSERT_EQ(test::give(world, swell(0.4, 0.3)), std::nullopt);
    }
    if (step == 20) {
      ASSERT_EQ(test::give(world, (SetWaves{{}, 0.1})), std::nullopt);
    }
  });
}

TEST(WorldWaves, ArePartOfTheState) {
  World one(patch_in_a_sea(), {1, nullptr, {}}), other(patch_in_a_sea(), {1, nullptr, {}});
  ASSERT_EQ(test::give(other, swell(5.0)), std::nullopt);
  EXPECT_EQ(test::first_difference(one, other), "sea.layers.size: 1 and 2");
}

/// Bytes that were made by hand may hold a sea without layers; no command makes one.
TEST(WorldWaves, OfAStateWithoutLayersAreNotAccepted) {
  const World world(patch_in_a_sea(), {1, nullptr, {}});
  WorldState state = world.state();
  EXPECT_TRUE(world.accepts(state));
  from_bytes(std::vector<std::byte>(24), state.sea);  // no layers, level 0, depth 0
  EXPECT_FALSE(world.accepts(state));
}

TEST(WorldWaves, AreRefusedWithTheValueAndWhatIsAllowed) {
  World world(patch_in_a_sea(), {1, nullptr, {}});
  const auto expect_refused = [&](const SetWaves& command, const auto& why) {
    const std::uint64_t before = hash_fields(world.state());
    EXPECT_THAT(test::give(world, command), Optional(why));
    EXPECT_EQ(hash_fields(world.state()), before) << "nothing has changed";
  };
  expect_refused({{{0.1, 9.0, 0.0, 0.0, 0.0}, {3.0, 20.0, 0.0, 0.0, 0.0}}, 5.0},
                 AllOf(HasSubstr("wave[1].amplitude: 3 m is too steep"), HasSubstr("allowed: at most 1.412 m")));
  for (int n = 1; n <= 7; ++n) ASSERT_EQ(test::give(world, swell(8.0 - n)), std::nullopt);
  expect_refused(swell(1.0), AllOf(HasSubstr("allowed: 7 changes at a time"), HasSubstr("can begin at 1.0 s")));
  while (world.time() < 1.0) world.advance();
  EXPECT_EQ(test::give(world, swell(1.0)), std::nullopt) << "one of them is over";
}

}  // namespace

}  // namespace pelagos
