// Timed commands and the current of a scene, and command logs.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "scene/command_log.hpp"
#include "scene_text.hpp"

namespace pelagos {
namespace {

using test::FaultCase;
using test::read_with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kWesterly = "wind { speed: 5 from_deg: 270 }\n";

TEST(SceneEvents, KeepTheOrderOfTheFile) {
  const SceneResult result = read_with(kWesterly +
                                       "event { at: 20 clear_wind { } }\n"
                                       "event { at: 0 set_wind { wind { beaufort: 8 } ramp: 5 } }\n"
                                       "event { at: 10 pause { } }\n"
                                       "event { at: 10 set_current { current { speed: 1 to_deg: 90 } } }\n");
  ASSERT_TRUE(result) << result.report();
  const auto& events = result.scene->events;
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[0].at, 20.0);
  EXPECT_TRUE(std::holds_alternative<ClearWind>(events[0].command));
  EXPECT_EQ(std::get<SetWind>(events[1].command).ramp_seconds, 5.0);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(events[2].command));
  EXPECT_NEAR(std::get<SetCurrent>(events[3].command).current.velocity.x(), 1.0, 1e-12);  // the sine rounds
}

/// What is left out is taken from the wind last set when the event takes effect; that a direction is there is known.
TEST(SceneEvents, AreCheckedWithTheWindOfTheirTimeNotOfTheirPlace) {
  const SceneResult result = read_with(kWesterly +
                                       "event { at: 20 set_wind { wind { from_deg: 180 } } }\n"
                                       "event { at: 10 set_wind { wind { speed: 12 } } }\n");
  ASSERT_TRUE(result) << result.report();
  EXPECT_EQ(std::get<SetWind>(result.scene->events[1].command).wind.speed, 12.0);
  EXPECT_EQ(std::get<SetWind>(result.scene->events[0].command).wind.from_deg, 180.0);
  EXPECT_FALSE(std::get<SetWind>(result.scene->events[0].command).wind.speed);
  EXPECT_THAT(read_with("event { at: 20 set_wind { wind { speed: 12 from_deg: 0 } } }\n"
                        "event { at: 10 set_wind { wind { from_deg: 180 } } }\n")
                  .faults,
              ElementsAre(AllOf(HasSubstr("event[1].set_wind.wind"), HasSubstr("gives no mean wind"))));
}

class SceneEventFault : public testing::TestWithParam<FaultCase> {};

TEST_P(SceneEventFault, NamesLineFieldAndWhatIsAllowed) { test::expect_only_fault(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Fields, SceneEventFault,
    testing::Values(
        FaultCase{"NoTime", "event { pause { } }", "event[0].at", "is missing"},
        FaultCase{"Negative", "event { at: -1 pause { } }", "event[0].at", "-1 is out of range; allowed: 0 to"},
        FaultCase{"Nan", "event { at: nan pause { } }", "event[0].at", "nan"},
        FaultCase{"Infinite", "event { at: inf pause { } }", "event[0].at", "inf"},
        FaultCase{"Nothing", "event { at: 1 }", "event[0]", "allowed: one command"},
        FaultCase{"Resume", "event { at: 1 resume { } }", "event[0].resume", "paused"},
        FaultCase{"Step", "event { at: 1 step { } }", "event[0].step", "paused"},
        FaultCase{"Effort", "event { at: 1 set_effort { } }", "event[0].set_effort", "command logs only"},
        FaultCase{"LogField", "event { at: 1 before_step: 3 pause { } }", "event[0].before_step", "command logs"},
        FaultCase{"Wind", "event { at: 1 set_wind { wind { speed: 99 from_deg: 0 } } }", "event[0].set_wind.wind.speed",
                  "0 to 75 m/s"},
        FaultCase{"WindOfNone", "event { at: 1 set_wind { wind { from_deg: 0 } } }", "event[0].set_wind.wind",
                  "exactly one of speed"},
        FaultCase{"WindAfterCalm",
                  "wind { velocity { x: 1 } } event { at: 2 set_wind { wind { from_deg: 0 } } } event { at: 1 "
                  "clear_wind { } }",
                  "event[0].set_wind.wind", "exactly one of speed"},
        FaultCase{"WindWithoutGravity",
                  "gravity: 0 time_step { max_step: 0.01 } event { at: 1 set_wind { wind { velocity { x: 1 } } } }",
                  "event[0].set_wind", "without gravity"},
        FaultCase{"Ramp", "event { at: 1 set_current { current { speed: 0 } ramp: -1 } }", "event[0].set_current.ramp",
                  "0 to 3600 s"},
        FaultCase{"CurrentSpeed", "current { speed: 11 to_deg: 0 }", "current.speed", "0 to 10 m/s"},
        FaultCase{"CurrentDepth", "current { speed: 1 to_deg: 0 shear: LINEAR depth: 0 }", "current.depth",
                  "0.01 to 11000 m"},
        FaultCase{"CurrentNoDepth", "current { speed: 1 to_deg: 0 shear: LINEAR }", "current.depth", "is missing"}),
    [](const auto& entry) { return entry.param.name; });

TEST(SceneEvents, RefuseAnUnknownCommandWithTheOnesThatThereAre) {
  EXPECT_THAT(read_with("event { at: 1 set_wnd { } }").faults,
              testing::Contains(AllOf(HasSubstr("did you mean \"set_wind\""), HasSubstr("set_current"))));
  EXPECT_THAT(read_with("current { speed: 1 to_deg: 0 shear: CUBIC depth: 1 }").faults,
              ElementsAre(HasSubstr("Allowed: NONE, LINEAR, SEVENTH_POWER")));
}

TEST(SceneEvents, AreBounded) {
  std::string text;
  for (int i = 0; i < 1001; ++i) text += "event { at: 1 pause { } } ";
  EXPECT_THAT(read_with(text).faults, ElementsAre(HasSubstr("1,001 entries; allowed: at most 1,000")));
}

// ---- command logs

/// A file that goes away with the test.
class LogFile {
 public:
  ~LogFile() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string path() const { return path_; }
  [[nodiscard]] std::string text() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::string path_ = std::filesystem::temp_directory_path() / ("pelagos_log_" + std::to_string(getpid()) + ".log");
};

const CommandLogHeader kHeader{
    "1.2", "avx2", "small", 18446744073709551615U, 729, {{"patch", 0x0123456789abcdefU}, {"wind at the start", 1}}};

SetWind awkward_wind() {  // no digit of these may be lost
  SetWind set;
  set.wind.velocity = wind_velocity(75.0, 33.3);  // about as long as allowed, or a bit more
  set.wind.amplitude = 0.1 + 0.2;
  set.wind.length = 1.0 / 3.0;
  set.wind.beta = 1e-300;
  set.ramp_seconds = 2.0 / 7.0;
  return set;
}

TEST(CommandLogFile, ReadsBackEveryBit) {
  const LogFile file;
  SetWind pulsed = awkward_wind();
  pulsed.wind.pulse = WindPulse{1.0 / 0.3, 1.1};
  SetCurrent current;
  current.current.velocity = current_velocity(5.0, 77.7);
  current.current.shear = CurrentShear::kSeventhPower;
  current.current.depth = 100.0 / 3.0;
  current.current.relaxation = 1.0 / 0.7;
  current.ramp_seconds = 0.7;
  {
    CommandLogWriter writer(file.path());
    writer.write(kHeader);
    writer.write({3, 0.1 * 3, "scene event 2", pulsed});
    SetWind real = awkward_wind();  // its pulse is gone again
    real.wind.law = WindLaw::kStress;
    real.wind.roughness = 1e-3 / 3.0;
    writer.write({3, 0.3, "station 127.0.0.1:40112", real});
    writer.write({4, 0.4, "a", ClearWind{}});
    writer.write({5, 0.5, "a", current});
    writer.write({6, 0.6, "a", ClearCurrent{}});
    writer.write({7, 0.7, "governor", SetEffort{{0.01 / 3.0, 1e-3, 2e-3}, "coarser, \"it\" took 3 ms"}});
    writer.write({8, 0.8, "a", PauseSimulation{}});
    writer.write({8, 0.8, "a", StepSimulation{12}});
    writer.write({20, 0.9, "a", ResumeSimulation{}});
    writer.write(CommandLogEnd{31, 0x0123456789abcdefU});
    EXPECT_FALSE(writer.failed());
  }
  const CommandLogResult result = read_command_log_file(file.path());
  ASSERT_TRUE(result.log) << result.faults.front();
  EXPECT_EQ(result.log->header.scene, "small");
  EXPECT_EQ(result.log->header.seed, kHeader.seed);
  EXPECT_EQ(result.log->header.particles, 729U);
  EXPECT_EQ(result.log->header.parts, kHeader.parts);
  const auto& commands = result.log->commands;
  ASSERT_EQ(commands.size(), 9U);
  EXPECT_EQ(commands[0].before_step, 3U);
  EXPECT_EQ(commands[0].time, 0.1 * 3);
  EXPECT_EQ(commands[0].source, "scene event 2");
  const auto first = std::get<SetWind>(commands[0].command), second = std::get<SetWind>(commands[1].command);
  EXPECT_EQ(first.wind.velocity, pulsed.wind.velocity);
  EXPECT_EQ(first.wind.amplitude, pulsed.wind.amplitude);
  EXPECT_EQ(first.wind.length, pulsed.wind.length);
  EXPECT_EQ(first.wind.beta, pulsed.wind.beta);
  EXPECT_EQ(first.wind.pulse->period, pulsed.wind.pulse->period);
  EXPECT_EQ(first.ramp_seconds, pulsed.ramp_seconds);
  EXPECT_FALSE(second.wind.pulse);
  EXPECT_EQ(second.wind.law, WindLaw::kStress);
  EXPECT_EQ(second.wind.roughness, 1e-3 / 3.0);
  const auto set = std::get<SetCurrent>(commands[3].command);
  EXPECT_EQ(set.current.velocity, current.current.velocity);
  EXPECT_EQ(set.current.shear, CurrentShear::kSeventhPower);
  EXPECT_EQ(set.current.depth, current.current.depth);
  EXPECT_EQ(set.current.relaxation, current.current.relaxation);
  EXPECT_EQ(set.ramp_seconds, 0.7);
  EXPECT_EQ(std::get<SetEffort>(commands[5].command).effort, (Effort{0.01 / 3.0, 1e-3, 2e-3}));
  EXPECT_EQ(std::get<SetEffort>(commands[5].command).reason, "coarser, \"it\" took 3 ms");
  EXPECT_EQ(std::get<StepSimulation>(commands[7].command).steps, 12U);
  ASSERT_TRUE(result.log->end);
  EXPECT_EQ(result.log->end->step, 31U);
  EXPECT_EQ(result.log->end->state_hash, 0x0123456789abcdefU);
}

TEST(CommandLogFile, OfARunThatWasCutOffCanBeRead) {
  const LogFile file;
  CommandLogWriter writer(file.path());
  writer.write(kHeader);
  writer.write({3, 0.3, "a", ClearWind{}});
  const CommandLogResult result = read_command_log_file(file.path());  // while it is still open
  ASSERT_TRUE(result.log);
  EXPECT_EQ(result.log->commands.size(), 1U);
  EXPECT_FALSE(result.log->end);
}

TEST(CommandLogFile, SaysWhatIsWrongWithIt) {
  const std::string header = "scene: \"small\" seed: 1 particles: 729\n";
  const auto faults = [&](const std::string& text) { return read_command_log_text(header + text, "a.log").faults; };
  EXPECT_TRUE(faults("").empty());
  EXPECT_THAT(read_command_log_text("", "a.log").faults,
              ElementsAre(HasSubstr("scene"), HasSubstr("seed"), HasSubstr("particles")));
  EXPECT_THAT(faults("command { pause { } }"), ElementsAre(HasSubstr("a.log:2: command[0].before_step: is missing")));
  EXPECT_THAT(faults("command { before_step: 1 }"), ElementsAre(HasSubstr("holds no command")));
  EXPECT_THAT(faults("command { before_step: 2 pause { } } command { before_step: 1 pause { } }"),
              ElementsAre(HasSubstr("allowed: steps in order")));
  EXPECT_THAT(faults("command { before_step: 1 set_wind { wind { speed: 100 from_deg: 0 } } }"),
              ElementsAre(HasSubstr("command[0].set_wind.wind.speed")));
  EXPECT_THAT(faults("end { step: 3 state_hash: \"xyz\" }"), ElementsAre(HasSubstr("16 hexadecimal digits")));
  EXPECT_THAT(faults("comand { }"), ElementsAre(HasSubstr("did you mean \"command\"")));
  EXPECT_THAT(faults("command {\n"), ElementsAre(StartsWith("a.log:")));
  EXPECT_THAT(read_command_log_file("/nowhere/a.log").faults, ElementsAre(HasSubstr("no such command log file")));
}

TEST(CommandLogFile, NoticesThatItCannotBeWritten) {
  EXPECT_TRUE(CommandLogWriter("/nowhere/a.log").failed());
  CommandLogWriter full("/dev/full");
  full.write(kHeader);
  EXPECT_TRUE(full.failed());
}

}  // namespace
}  // namespace pelagos
