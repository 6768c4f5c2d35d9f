// The waves around the patch: of a scene one by one, and those that an event exchanges them for.

#include <gmock/gmock.h>

#include <cmath>

#include "scene/command_log.hpp"
#include "scene_text.hpp"
#include "waves/dispersion.hpp"

namespace pelagos {
namespace {

using test::expect_only_fault_in;
using test::FaultCase;
using test::read_with;
using testing::HasSubstr;

std::string repeat(const std::string& text, int times) {
  std::string all;
  for (int n = 0; n < times; ++n) all += text;
  return all;
}

TEST(SceneWaves, AreReadByLengthOrPeriod) {
  const SceneResult result = read_with(
      "far_sea {\n"
      "  wave { amplitude: 1.2 length: 60 to_deg: 270 phase_deg: -90 }\n"
      "  wave { amplitude: 0.4 period: 5 to_deg: 0 }\n"
      "}\n"
      "event { at: 3 set_waves { wave { amplitude: 0.5 length: 25 to_deg: 90 } blend: 30 } }\n"
      "event { at: 9 set_waves { flat: true } }\n");
  ASSERT_TRUE(result) << result.report();
  const std::vector<WaveSettings>& waves = result.scene->far_sea.waves;
  ASSERT_EQ(waves.size(), 2U);
  EXPECT_EQ(waves[0].amplitude, 1.2);
  EXPECT_EQ(waves[0].length, 60.0);
  EXPECT_EQ(waves[0].to_deg, 270.0);
  EXPECT_EQ(waves[0].phase_deg, -90.0);
  EXPECT_EQ(waves[1].period, 5.0);
  const auto& first = std::get<SetWaves>(result.scene->events[0].command);
  const auto& second = std::get<SetWaves>(result.scene->events[1].command);
  ASSERT_EQ(first.waves.size(), 1U);
  EXPECT_EQ(first.waves[0].length, 25.0);
  EXPECT_EQ(first.blend_seconds, 30.0);
  EXPECT_TRUE(second.waves.empty());
  EXPECT_EQ(second.blend_seconds, 0.0);
}

TEST(SceneWaves, BecomeComponentsOfDeepWater) {
  constexpr double kGravity = 9.81;
  const WaveComponent by_length = wave_component({1.2, 60.0, 0.0, 270.0, 90.0}, kGravity);
  EXPECT_FLOAT_EQ(by_length.amplitude, 1.2F);
  EXPECT_NEAR(by_length.wavenumber, 2.0 * M_PI / 60.0, 1e-8);
  EXPECT_NEAR(by_length.omega, std::sqrt(kGravity * 2.0 * M_PI / 60.0), 1e-7);
  EXPECT_NEAR(std::cos(by_length.direction), -1.0, 1e-6) << "towards the west";
  EXPECT_NEAR(by_length.phase, 0.5 * M_PI, 1e-6);
  const WaveComponent by_period = wave_component({0.4, 0.0, 5.0, 0.0, 0.0}, kGravity);
  EXPECT_NEAR(by_period.omega, 2.0 * M_PI / 5.0, 1e-7);
  EXPECT_NEAR(by_period.wavenumber, std::pow(2.0 * M_PI / 5.0, 2) / kGravity, 1e-8);
  EXPECT_NEAR(std::sin(by_period.direction), 1.0, 1e-6) << "towards the north";
}

/// A scene's own waves and those of a command: the same faults, told with the path of each.
class WaveFault : public testing::TestWithParam<FaultCase> {};

TEST_P(WaveFault, OfAScene) { expect_only_fault_in("far_sea { ", GetParam(), " }", "far_sea."); }
TEST_P(WaveFault, OfACommand) {
  expect_only_fault_in("event { at: 1 set_waves { ", GetParam(), " } }", "event[0].set_waves.");
}

INSTANTIATE_TEST_SUITE_P(
    Fields, WaveFault,
    testing::Values(
        FaultCase{"AmplitudeNan", "wave { amplitude: nan length: 60 to_deg: 0 }",
                  "wave[0].amplitude: ", "nan is out of range; allowed: 0.001 to 15 m"},
        FaultCase{"AmplitudeNegative", "wave { amplitude: -1 length: 60 to_deg: 0 }", "wave[0].amplitude: ", "-1 is"},
        FaultCase{"AmplitudeZero", "wave { amplitude: 0 length: 60 to_deg: 0 }", "wave[0].amplitude: ", "0 is out of"},
        FaultCase{"AmplitudeInfinite", "wave { amplitude: inf length: 60 to_deg: 0 }",
                  "wave[0].amplitude: ", "inf is out of range"},
        FaultCase{"AmplitudeMissing", "wave { length: 60 to_deg: 0 }", "wave[0].amplitude: ", "is missing"},
        FaultCase{"LengthZero", "wave { amplitude: 1 length: 0 to_deg: 0 }", "wave[0].length: ", "0.1 to 10000 m"},
        FaultCase{"LengthMissing", "wave { amplitude: 1 to_deg: 0 }", "wave[0].length: ", "it or the period"},
        FaultCase{"LengthTwice", "wave { amplitude: 1 length: 60 period: 6 to_deg: 0 }",
                  "wave[0].period: ", "one of them"},
        FaultCase{"PeriodNegative", "wave { amplitude: 1 period: -6 to_deg: 0 }", "wave[0].period: ", "0.25 to 80 s"},
        FaultCase{"DirectionMissing", "wave { amplitude: 1 length: 60 }", "wave[0].to_deg: ", "is missing"},
        FaultCase{"Direction", "wave { amplitude: 1 length: 60 to_deg: 361 }", "wave[0].to_deg: ", "0 to 360"},
        FaultCase{"Phase", "wave { amplitude: 1 length: 60 to_deg: 0 phase_deg: 400 }",
                  "wave[0].phase_deg: ", "-360 to 360"},
        FaultCase{"SecondWave", "wave { amplitude: 1 length: 60 to_deg: 0 } wave { amplitude: 5 length: 20 to_deg: 0 }",
                  "wave[1].amplitude: ", "5 m is too steep for a wave of 20 m; allowed: at most 1.412 m"},
        FaultCase{"SteepByPeriod", "wave { amplitude: 1 period: 2 to_deg: 0 }",
                  "wave[0].amplitude: ", "allowed: at most 0.4409 m"},  // 0.0706 g T^2 / (2 pi)
        FaultCase{"SteepTogether",
                  "wave { amplitude: 1.4 length: 20 to_deg: 0 } wave { amplitude: 1.4 length: 20 to_deg: 90 }",
                  "wave: ", "of 0.622; allowed: at most 0.444"},
        FaultCase{"HighTogether",
                  "wave { amplitude: 8 length: 900 to_deg: 0 } wave { amplitude: 8 length: 900 to_deg: 9 }",
                  "wave: ", "significant height of 32 m; allowed: at most 30 m"}),
    [](const auto& entry) { return entry.param.name; });

TEST(SceneWaves, AreBoundedInNumber) {
  const std::string one = "wave { amplitude: 0.01 length: 60 to_deg: 0 } ";
  EXPECT_TRUE(read_with("far_sea { " + repeat(one, 512) + "}"));
  EXPECT_THAT(read_with("far_sea { " + repeat(one, 513) + "}").report(),
              HasSubstr("far_sea.wave: has 513 entries; allowed: at most 512"));
  EXPECT_TRUE(read_with("event { at: 1 set_waves { " + repeat(one, 512) + "} }"));
  EXPECT_THAT(read_with("event { at: 1 set_waves { " + repeat(one, 513) + "} }").report(),
              HasSubstr("event[0].set_waves.wave: has 513 entries; allowed: at most 512"));
}

class SetWavesFault : public testing::TestWithParam<FaultCase> {};
TEST_P(SetWavesFault, NamesLineFieldAndWhatIsAllowed) { test::expect_only_fault(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Fields, SetWavesFault,
    testing::Values(FaultCase{"Empty", "event { at: 1 set_waves { blend: 5 } }", "event[0].set_waves.wave",
                              "allowed: 1 to 512 waves, or flat: true"},
                    FaultCase{"FlatBesideWaves",
                              "event { at: 1 set_waves { flat: true wave { amplitude: 1 length: 60 to_deg: 0 } } }",
                              "event[0].set_waves.flat", "one of them"},
                    FaultCase{"BlendNegative", "event { at: 1 set_waves { flat: true blend: -1 } }",
                              "event[0].set_waves.blend", "-1 is out of range; allowed: 0 to 3600 s"},
                    FaultCase{"BlendLong", "event { at: 1 set_waves { flat: true blend: 3601 } }",
                              "event[0].set_waves.blend", "0 to 3600 s"},
                    FaultCase{"BlendNan", "event { at: 1 set_waves { flat: true blend: nan } }",
                              "event[0].set_waves.blend", "nan is out of range"},
                    FaultCase{"BesideBeaufort", "far_sea { beaufort: 4 wave { amplitude: 1 length: 60 to_deg: 0 } }",
                              "far_sea.beaufort", "is given beside waves"}),
    [](const auto& entry) { return entry.param.name; });

}  // namespace
}  // namespace pelagos
