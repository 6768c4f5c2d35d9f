// Releases, spills, booms, skimmers and probes as events of a scene: what fits it and what does not.

#include <gmock/gmock.h>

#include "scene_text.hpp"
#include "values/given_names.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {
namespace {

using test::FaultCase;
using test::read_with;
using testing::AllOf;
using testing::HasSubstr;

TEST(SceneOilEvents, AreTakenWhereTheyFit) {
  const SceneResult result = read_with(
      "oil { type: \"diesel\" model: SLICK } "
      "event { at: 9 remove_boom { name: \"b\" } } "  // after the boom, though written before it
      "event { at: 1 release_oil { name: \"leak\" from { x: 0.5 y: 0.5 z: 0.5 } rate: 1 } } "
      "event { at: 2 spill_oil { position { x: 0.5 y: 0.5 } volume: 0.01 } } "
      "event { at: 3 set_boom { name: \"b\" point { x: -9 y: 0.5 } point { x: 9 y: 0.5 } } } "
      "event { at: 4 set_skimmer { name: \"s\" position { x: 1 y: 1 } } } "
      "event { at: 5 stop_release { name: \"leak\" } } event { at: 6 remove_skimmer { name: \"s\" } } "
      "event { at: 7 remove_probe { id: 4 } } probe { id: 4 position { x: 0.5 y: 0.5 } }");
  ASSERT_TRUE(result) << result.report();
  EXPECT_EQ(result.scene->events.size(), 8U);
}

class SceneOilEventFault : public testing::TestWithParam<FaultCase> {};
INSTANTIATE_TEST_SUITE_P(
    Fields, SceneOilEventFault,
    testing::Values(
        FaultCase{"NoOil", "event { at: 1 spill_oil { position { x: 1 y: 1 } volume: 1 } }", "event[0].spill_oil",
                  "the scene has no oil"},
        FaultCase{"NoFilm", "oil { } event { at: 1 spill_oil { position { x: 1 y: 1 } volume: 1 } }",
                  "event[0].spill_oil", "allowed with oil.model SLICK or BOTH in the scene, and here it is PARTICLES"},
        FaultCase{"BoomNoFilm", "oil { } event { at: 1 set_boom { name: \"b\" point { } point { x: 1 } } }",
                  "event[0].set_boom", "a boom works on the slick layer"},
        FaultCase{"SkimmerNoFilm", "oil { } event { at: 1 set_skimmer { name: \"s\" position { } } }",
                  "event[0].set_skimmer", "a skimmer works on the slick layer"},
        FaultCase{"SourceOutside", "oil { } event { at: 1 release_oil { name: \"a\" from { x: 99 } rate: 1 } }",
                  "event[0].release_oil.from", "(99, 0, 0) m is outside the patch; allowed: (0, 0, 0) to "},
        FaultCase{"SourceAbove", "oil { } event { at: 1 release_oil { name: \"a\" from { z: 99 } rate: 1 } }",
                  "event[0].release_oil.from", "outside the patch"},
        FaultCase{"LineOutside", "oil { } event { at: 1 release_oil { name: \"a\" from { } to { y: -1 } rate: 1 } }",
                  "event[0].release_oil.to", "(0, -1, 0) m is outside the patch"},
        FaultCase{"SourceOnNobody", "oil { } event { at: 1 release_oil { name: \"a\" from { } rate: 1 body: 3 } }",
                  "event[0].release_oil.body", "the scene has no body 3; allowed: none, it has no bodies"},
        FaultCase{"SpillOutside", "oil { model: SLICK } event { at: 1 spill_oil { position { x: -1 } volume: 1 } }",
                  "event[0].spill_oil.position", "(-1, 0) m is outside the patch; allowed: (0, 0) to "},
        FaultCase{"SkimmerOutside",
                  "oil { model: BOTH } event { at: 1 set_skimmer { name: \"s\" position { y: 99 } } }",
                  "event[0].set_skimmer.position", "(0, 99) m is outside the patch"},
        FaultCase{"BoomOutside",
                  "oil { model: SLICK } event { at: 1 set_boom { name: \"b\" point { x: -1 y: 0 } point { x: -1 y: 9 } "
                  "point { x: 9 y: 19 } } }",
                  "event[0].set_boom.point", "all of the boom is outside the patch"},
        FaultCase{"BoomPointsMeet",
                  "oil { model: SLICK } event { at: 1 set_boom { name: \"b\" point { } point { x: 0.05 } } }",
                  "event[0].set_boom.point[1]", "0.05 m from the point before; allowed: at least 0.1 m"},
        FaultCase{"UnknownSource", "oil { } event { at: 1 stop_release { name: \"leak\" } }",
                  "event[0].stop_release.name", "there is no source \"leak\", nor any other"},
        FaultCase{"BoomBeforeItIsThere",
                  "oil { model: SLICK } event { at: 1 remove_boom { name: \"b\" } } "
                  "event { at: 2 set_boom { name: \"b\" point { } point { x: 1 } } }",
                  "event[0].remove_boom.name", "there is no boom \"b\""},
        FaultCase{"UnknownProbe", "probe { id: 4 position { x: 1 y: 1 } } event { at: 1 remove_probe { id: 5 } }",
                  "event[0].remove_probe.id", "there is no probe 5; allowed: 4"},
        FaultCase{"ProbeOutside", "event { at: 1 set_probe { id: 4 position { x: 99 y: 1 } } }",
                  "event[0].set_probe.position", "(99, 1) m is outside the patch"},
        FaultCase{"NoRate", "oil { } event { at: 1 release_oil { name: \"a\" from { } } }", "event[0].release_oil.rate",
                  "is missing"},
        FaultCase{"Past", "oil { model: SLICK } event { at: -1 spill_oil { position { } volume: 1 } }", "event[0].at",
                  "-1 is out of range; allowed: 0 to"}),
    [](const auto& entry) { return entry.param.name; });

TEST_P(SceneOilEventFault, IsNamedWithWhatIsAllowed) { test::expect_only_fault(GetParam()); }

TEST(GivenNames, OfferTheNearestAndListTheRest) {
  GivenNames given;
  for (const char* name : {"north", "south"}) given.follow(OilCommand{SetBoom{name, {}, 0.5, 0.36}});
  const auto refusal = find_unknown_name(OilCommand{RemoveBoom{"nroth"}}, given);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(to_string(*refusal),
            "name: there is no boom \"nroth\"; did you mean \"north\"? allowed: \"north\", \"south\"");
  EXPECT_FALSE(find_unknown_name(OilCommand{RemoveBoom{"north"}}, given));
  EXPECT_TRUE(find_unknown_name(OilCommand{RemoveSkimmer{"north"}}, given)) << "a name of another kind";
  given.follow(OilCommand{RemoveBoom{"north"}});
  EXPECT_TRUE(find_unknown_name(OilCommand{RemoveBoom{"north"}}, given));
}

TEST(GivenNames, ListEightAtMost) {
  GivenNames given;
  for (int k = 0; k < 12; ++k) {
    given.follow(OilCommand{SetSkimmer{"rig " + std::to_string(k), {1.0, 1.0}, 1.0, 1.0}});
    ProbeSettings probe;
    probe.id = static_cast<std::uint32_t>(k + 1);
    given.follow(SetProbe{probe});
  }
  EXPECT_THAT(find_unknown_name(OilCommand{RemoveSkimmer{"x"}}, given)->what,
              AllOf(HasSubstr("\"rig 0\", \"rig 1\", \"rig 10\""), HasSubstr(" and 4 more")));
  EXPECT_THAT(find_unknown_name(RemoveProbe{99}, given)->what, HasSubstr("allowed: 1, 2, 3, 4, 5, 6, 7, 8 and 4 more"));
}

/// `count` events that each set a boom of its own, of `points` points.
std::string booms(int count, int points) {
  std::string line, text = "oil { type: \"diesel\" model: SLICK } ";
  for (int k = 0; k < points; ++k)
    line += "point { x: " + std::to_string(0.15 * k) + " y: " + (k % 2 == 0 ? "0" : "1") + " } ";
  for (int k = 0; k < count; ++k)
    text += "event { at: " + std::to_string(k) + " set_boom { name: \"b" + std::to_string(k) + "\" " + line + "} } ";
  return text;
}

TEST(SceneOilEvents, HaveRoomForSoManyBoomsAndPoints) {
  EXPECT_TRUE(read_with(booms(100, 2)));
  EXPECT_TRUE(read_with(booms(101, 2) + "event { at: 99.5 remove_boom { name: \"b3\" } }")) << "one is gone by then";
  EXPECT_THAT(read_with(booms(101, 2)).report(),
              AllOf(HasSubstr("event[100].set_boom"), HasSubstr("there are 100 booms; allowed: at most 100")));
  EXPECT_TRUE(read_with(booms(4, 1000)));
  EXPECT_THAT(read_with(booms(5, 1000)).report(),
              AllOf(HasSubstr("event[4].set_boom.point"), HasSubstr("has 1000 points; allowed: at most 0")));
}

TEST(GivenNames, TellWhereThereIsNoRoom) {
  GivenNames given;
  for (std::size_t k = 0; k < kMostSkimmers; ++k)
    given.follow(OilCommand{SetSkimmer{"rig " + std::to_string(k), {1.0, 1.0}, 1.0, 1.0}});
  EXPECT_EQ(find_no_room(OilCommand{SetSkimmer{"more", {1.0, 1.0}, 1.0, 1.0}}, given)->what,
            "there are 100 skimmers; allowed: at most 100; remove one first");
  EXPECT_FALSE(find_no_room(OilCommand{SetSkimmer{"rig 7", {1.0, 1.0}, 1.0, 1.0}}, given));
  ProbeSettings probe;
  for (probe.id = 1; probe.id <= kMostProbes; ++probe.id) given.follow(SetProbe{probe});
  EXPECT_EQ(find_no_room(SetProbe{probe}, given)->what, "there are 256 probes; allowed: at most 256; remove one first");
  probe.id = 5;
  EXPECT_FALSE(find_no_room(SetProbe{probe}, given));
}

TEST(CommandSurroundings, ABoomNeedsAPieceInThePatch) {
  const CommandSurroundings around{{{0, 0, 0}, {10, 5, 3}}, {}, OilModel::kSlick};
  const auto fits = [&](std::vector<Eigen::Vector2d> line) {
    return !find_refusal(OilCommand{SetBoom{"b", std::move(line), 0.5, 0.36}}, around);
  };
  EXPECT_TRUE(fits({{1, 1}, {2, 2}}));
  EXPECT_TRUE(fits({{-5, 2}, {15, 3}})) << "across, moored on both shores";
  EXPECT_TRUE(fits({{-5, 2}, {0, 2}})) << "touches";
  EXPECT_TRUE(fits({{4, -1}, {4, 6}})) << "along an axis";
  EXPECT_TRUE(fits({{-9, -9}, {-8, -9}, {5, 2}}));
  EXPECT_FALSE(fits({{-5, 2}, {-0.1, 2}}));
  EXPECT_FALSE(fits({{-2, 4}, {2, 8}})) << "past a corner";
  EXPECT_FALSE(fits({{-1, -1}, {11, -1}}));
}

}  // namespace
}  // namespace pelagos
