// The sea around the patch by systems: of a scene, and of the command set_sea.

#include <gmock/gmock.h>

#include <cmath>

#include "scene/command_log.hpp"
#include "scene_text.hpp"
#include "values/sea_request.hpp"

namespace pelagos {
namespace {

using test::expect_only_fault_in;
using test::FaultCase;
using test::read_with;
using testing::AllOf;
using testing::HasSubstr;

TEST(SceneSea, IsReadBySystems) {
  const SceneResult result = read_with(
      "far_sea {\n"
      "  system { height: 2 peak_period: 7 to_deg: 250 }\n"
      "  system { spectrum: OCHI_HUBBLE height: 1.5 mean_period: 10 to_deg: 300 shape: 4 spreading: 40 }\n"
      "  system { spectrum: REGULAR height: 0.5 zero_crossing_period: 9 to_deg: 20 phase_deg: 90 }\n"
      "  system { spectrum: TMA height: 0.5 zero_crossing_period: 3 to_deg: 20 gamma: 2 long_crested: true }\n"
      "  components: 300 seed: 5 shortest_length: 2\n"
      "}\n"
      "event { at: 3 set_sea { system { beaufort: 5 to_deg: 90 spreading_at_peak: 20 } blend: 30 } }\n"
      "event { at: 9 set_sea { system { douglas: 4 to_deg: 90 } } }\n");
  ASSERT_TRUE(result) << result.report();
  ASSERT_TRUE(result.scene->far_sea.sea.has_value());
  const SeaSettings& sea = *result.scene->far_sea.sea;
  ASSERT_EQ(sea.systems.size(), 4U);
  EXPECT_EQ(sea.systems[0].spectrum, SpectrumKind::kJonswap);
  EXPECT_EQ(sea.systems[0].height, 2.0);
  EXPECT_EQ(sea.systems[0].period, 7.0);
  EXPECT_EQ(sea.systems[0].gamma, 3.3);
  EXPECT_EQ(sea.systems[0].spreading_kind, SpreadingKind::kByFrequency);
  EXPECT_EQ(sea.systems[0].spreading, 10.0);
  EXPECT_EQ(sea.systems[1].period_kind, PeriodKind::kMean);
  EXPECT_EQ(sea.systems[1].shape, 4.0);
  EXPECT_EQ(sea.systems[1].spreading_kind, SpreadingKind::kConstant);
  EXPECT_EQ(sea.systems[1].spreading, 40.0);
  EXPECT_EQ(sea.systems[2].phase_deg, 90.0);
  EXPECT_EQ(sea.systems[3].period_kind, PeriodKind::kZeroCrossing);
  EXPECT_EQ(sea.systems[3].spreading_kind, SpreadingKind::kLongCrested);
  EXPECT_EQ(sea.components, 300U);
  EXPECT_EQ(sea.seed, 5U);
  EXPECT_EQ(sea.shortest_length, 2.0);
  const auto& first = std::get<SetSea>(result.scene->events[0].command);
  EXPECT_EQ(first.sea.systems[0].spectrum, SpectrumKind::kPiersonMoskowitz);
  EXPECT_EQ(first.sea.systems[0].height, 2.0);
  EXPECT_EQ(first.sea.systems[0].beaufort, 5);
  EXPECT_EQ(first.sea.systems[0].spreading, 20.0);
  EXPECT_EQ(first.blend_seconds, 30.0);
  EXPECT_EQ(first.sea.components, 100U);
  EXPECT_EQ(first.sea.seed, std::nullopt);
  EXPECT_EQ(std::get<SetSea>(result.scene->events[1].command).sea.systems[0].height, 1.875);
}

TEST(SceneSea, IsToldInWords) {
  const auto words = [](const std::string& text) {
    const SceneResult result = read_with("far_sea { " + text + " }");
    return result ? describe_sea(*result.scene->far_sea.sea) : result.report();
  };
  EXPECT_EQ(words("system { height: 2 peak_period: 7 to_deg: 250 } "
                  "system { height: 1.5 peak_period: 12 to_deg: 9 gamma: 5 spreading: 30 }"),
            "wind sea JONSWAP, Hs 2 m, Tp 7 s, to 250 deg, gamma 3.3, spreading 10 at the peak; "
            "swell JONSWAP, Hs 1.5 m, Tp 12 s, to 009 deg, gamma 5, spreading 30");
  EXPECT_EQ(
      words("system { beaufort: 5 to_deg: 90 long_crested: true } shortest_length: 3"),
      "wind sea Pierson-Moskowitz of Beaufort 5, Hs 2 m, fully developed, to 090 deg, long-crested; without waves "
      "under 3 m");
  EXPECT_EQ(words("system { spectrum: REGULAR height: 1 peak_period: 6 to_deg: 0 } system { douglas: 0 to_deg: 0 }"),
            "regular wave of 1 m, 6 s, to 000 deg; flat sea of Douglas degree 0");
}

/// A scene's own sea and that of a command: the same faults, told with the path of each.
class SeaFault : public testing::TestWithParam<FaultCase> {};

TEST_P(SeaFault, OfAScene) { expect_only_fault_in("far_sea { ", GetParam(), " }", "far_sea."); }
TEST_P(SeaFault, OfACommand) {
  expect_only_fault_in("event { at: 1 set_sea { ", GetParam(), " } }", "event[0].set_sea.");
}

INSTANTIATE_TEST_SUITE_P(
    Fields, SeaFault,
    testing::Values(
        FaultCase{"HeightNan", "system { to_deg: 0 height: nan peak_period: 7 }",
                  "system[0].height: ", "nan is out of range; allowed: 0.01 to 30 m"},
        FaultCase{"HeightNegative", "system { to_deg: 0 height: -1 peak_period: 7 }",
                  "system[0].height: ", "-1 is out of"},
        FaultCase{"HeightZero", "system { to_deg: 0 height: 0 peak_period: 7 }", "system[0].height: ", "0 is out of"},
        FaultCase{"HeightMissing", "system { to_deg: 0 peak_period: 7 }",
                  "system[0].height: ", "is missing; required: it, douglas or beaufort"},
        FaultCase{"HeightBesideBeaufort", "system { to_deg: 0 height: 1 peak_period: 7 beaufort: 4 }",
                  "system[0].beaufort: ", "is given beside height; allowed: one of them"},
        FaultCase{"DouglasBesideBeaufort", "system { to_deg: 0 douglas: 1 beaufort: 4 }",
                  "system[0].beaufort: ", "beside douglas"},
        FaultCase{"Douglas", "system { to_deg: 0 douglas: 10 }",
                  "system[0].douglas: ", "10 is out of range; allowed: 0 to 9"},
        FaultCase{"Beaufort", "system { to_deg: 0 beaufort: 13 }", "system[0].beaufort: ", "0 to 12"},
        FaultCase{"PeriodBesideBeaufort", "system { to_deg: 0 beaufort: 4 peak_period: 7 }",
                  "system[0].peak_period: ", "is given beside beaufort, a fully developed sea; allowed: with a height"},
        FaultCase{"SpectrumBesideDouglas", "system { to_deg: 0 douglas: 4 spectrum: JONSWAP }",
                  "system[0].spectrum: ", "is given beside douglas"},
        FaultCase{"PeriodMissing", "system { to_deg: 0 height: 2 }",
                  "system[0].peak_period: ", "is missing; required: it, zero"},
        FaultCase{"PeriodTwice", "system { to_deg: 0 height: 2 peak_period: 8 mean_period: 7 }",
                  "system[0].mean_period: ", "is given beside peak_period; allowed: one of them"},
        FaultCase{"PeriodLong", "system { to_deg: 0 height: 2 zero_crossing_period: 41 }",
                  "system[0].zero_crossing_period: ", "41 is out of range; allowed: 0.5 to 40 s"},
        FaultCase{"PeriodInfinite", "system { to_deg: 0 height: 2 peak_period: inf }",
                  "system[0].peak_period: ", "inf is out of"},
        FaultCase{"DirectionMissing", "system { height: 2 peak_period: 8 }", "system[0].to_deg: ", "is missing"},
        FaultCase{"Direction", "system { height: 2 peak_period: 8 to_deg: 361 }", "system[0].to_deg: ", "0 to 360"},
        FaultCase{"GammaSmall", "system { to_deg: 0 height: 2 peak_period: 8 gamma: 0.9 }",
                  "system[0].gamma: ", "1 to 10"},
        FaultCase{"GammaLarge", "system { to_deg: 0 height: 2 peak_period: 8 gamma: 11 }",
                  "system[0].gamma: ", "1 to 10"},
        FaultCase{"GammaElsewhere",
                  "system { to_deg: 0 height: 2 peak_period: 8 spectrum: PIERSON_MOSKOWITZ gamma: 3 }",
                  "system[0].gamma: ", "allowed: with JONSWAP and TMA"},
        FaultCase{"GammaOfBeaufort", "system { to_deg: 0 beaufort: 4 gamma: 3 }",
                  "system[0].gamma: ", "JONSWAP and TMA"},
        FaultCase{"ShapeMissing", "system { to_deg: 0 height: 2 peak_period: 8 spectrum: OCHI_HUBBLE }",
                  "system[0].shape: ", "is missing"},
        FaultCase{"ShapeElsewhere", "system { to_deg: 0 height: 2 peak_period: 8 shape: 3 }",
                  "system[0].shape: ", "allowed: with OCHI_HUBBLE"},
        FaultCase{"PhaseElsewhere", "system { to_deg: 0 height: 2 peak_period: 8 phase_deg: 3 }",
                  "system[0].phase_deg: ", "allowed: with REGULAR"},
        FaultCase{"SpreadingZero", "system { to_deg: 0 height: 2 peak_period: 8 spreading: 0 }",
                  "system[0].spreading: ", "1 to 1000"},
        FaultCase{"SpreadingTwice", "system { to_deg: 0 height: 2 peak_period: 8 spreading: 9 spreading_at_peak: 9 }",
                  "system[0].spreading_at_peak: ", "one of them"},
        FaultCase{"SpreadingOfARegularWave",
                  "system { to_deg: 0 height: 2 peak_period: 8 spectrum: REGULAR spreading: 9 }",
                  "system[0].spreading: ", "is of many waves"},
        FaultCase{
            "SecondSystemSteep",
            "system { to_deg: 0 height: 1 peak_period: 7 } system { to_deg: 0 height: 2 peak_period: 4 }",
            "system[1].height: ",
            "2 m is too steep for a peak period of 4 s, a wave of 24.98 m; allowed: at most 1.665 m, 1/15 of that"},
        FaultCase{"SteepByZeroCrossings", "system { to_deg: 0 height: 3 zero_crossing_period: 4 }",
                  "system[0].height: ", "for a peak period of 5.1"},
        FaultCase{"RegularSteep", "system { to_deg: 0 spectrum: REGULAR height: 4 peak_period: 4 }",
                  "system[0].height: ", "allowed: at most 3.527 m, 0.1412 of that length"},
        FaultCase{"SteepTogether",
                  "system { to_deg: 0 height: 1.6 peak_period: 4 } system { to_deg: 0 height: 1.6 peak_period: 4 }",
                  "system: ", "1.36 times as steep as a sea can be"},
        FaultCase{"HighTogether",
                  "system { to_deg: 0 height: 25 peak_period: 25 } system { to_deg: 0 height: 25 peak_period: 25 }",
                  "system: ", "significant height of 35.4 m; allowed: at most 30 m"},
        FaultCase{"NoComponents", "system { to_deg: 0 beaufort: 4 }  components: 0", "components: ", "1 to 512"},
        FaultCase{"ManyComponents", "system { to_deg: 0 beaufort: 4 }  components: 513", "components: ", "1 to 512"},
        FaultCase{"FewComponents", "system { to_deg: 0 beaufort: 4 } system { to_deg: 0 beaufort: 4 }  components: 1",
                  "components: ", "1 are too few for 2 systems; allowed: 2 to 512"},
        FaultCase{"ShortestNan", "system { to_deg: 0 beaufort: 4 }  shortest_length: nan",
                  "shortest_length: ", "nan is out"},
        FaultCase{"AllTooShort", "system { to_deg: 0 beaufort: 4 }  shortest_length: 900",
                  "shortest_length: ", "all waves of the sea are shorter than 900 m"}),
    [](const auto& entry) { return entry.param.name; });

TEST(SceneSea, HasAtMostEightSystems) {
  std::string eight;
  for (int n = 0; n < 8; ++n) eight += "system { height: 1 peak_period: 7 to_deg: 0 } ";
  EXPECT_TRUE(read_with("far_sea { " + eight + "}"));
  EXPECT_THAT(read_with("far_sea { " + eight + "system { beaufort: 1 to_deg: 0 } }").report(),
              HasSubstr("far_sea.system: has 9 entries; allowed: at most 8"));
}

TEST(SceneSea, NamesTheSpectraWhereOneIsNotKnown) {
  EXPECT_THAT(read_with("far_sea { system { height: 1 peak_period: 7 to_deg: 0 spectrum: BRETSCHNEIDER } }").report(),
              AllOf(HasSubstr("BRETSCHNEIDER"), HasSubstr("Allowed: JONSWAP, PIERSON_MOSKOWITZ, TMA, OCHI_HUBBLE")));
}

class SetSeaFault : public testing::TestWithParam<FaultCase> {};
TEST_P(SetSeaFault, NamesLineFieldAndWhatIsAllowed) { test::expect_only_fault(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Fields, SetSeaFault,
    testing::Values(
        FaultCase{"Empty", "event { at: 1 set_sea { blend: 5 } }", "event[0].set_sea.system",
                  "is missing; allowed: 1 to 8 systems, or wind_sea, and for a flat sea set_waves { flat: true }"},
        FaultCase{"BlendLong", "event { at: 1 set_sea { system { beaufort: 4 to_deg: 0 } blend: 3601 } }",
                  "event[0].set_sea.blend", "0 to 3600 s"},
        FaultCase{"BesideBeaufort", "far_sea { beaufort: 4 system { beaufort: 4 to_deg: 0 } }", "far_sea.beaufort",
                  "is given beside systems; allowed: one or the other"},
        FaultCase{"BesideDirection", "far_sea { wave_to_deg: 4 system { beaufort: 4 to_deg: 0 } }",
                  "far_sea.wave_to_deg", "is given beside systems"},
        FaultCase{"BesideWaves",
                  "far_sea { wave { amplitude: 1 length: 60 to_deg: 0 } "
                  "system { beaufort: 4 to_deg: 0 } }",
                  "far_sea.system", "is given beside waves"},
        FaultCase{"BeaufortBesideWindSea", "far_sea { beaufort: 4 wind_sea { } }", "far_sea.beaufort",
                  "is given beside wind_sea"},
        FaultCase{"WavesBesideWindSea", "far_sea { wave { amplitude: 1 length: 60 to_deg: 0 } wind_sea { } }",
                  "far_sea.wind_sea", "is given beside waves"},
        FaultCase{"FetchShort", "far_sea { wind_sea { fetch: 10 } }", "far_sea.wind_sea.fetch", "1000 to 2000000 m"},
        FaultCase{"PaceOfNothing", "event { at: 1 set_sea { wind_sea { pace: 0 } } }", "event[0].set_sea.wind_sea.pace",
                  "0.1 to 100"},
        FaultCase{"SeedOfBeaufort", "far_sea { beaufort: 4 seed: 3 }", "far_sea.seed", "is of systems"}),
    [](const auto& entry) { return entry.param.name; });

}  // namespace
}  // namespace pelagos
