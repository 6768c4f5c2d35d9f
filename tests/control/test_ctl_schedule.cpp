// pelagos-ctl: current, commands with a time, the schedule.

#include <nlohmann/json.hpp>

#include "ctl_test.hpp"

namespace pelagos {
namespace {

using test::Outcome;
using testing::AllOf;
using testing::HasSubstr;

class CtlSchedule : public test::CtlTest {
 protected:
};

TEST_F(CtlSchedule, SendsEveryCurrentOption) {
  EXPECT_EQ(ask({"current", "--speed", "1.5", "--to", "90", "--ramp", "60", "--shear", "power", "--depth", "20",
                 "--relaxation", "5"})
                .code,
            0);
  ASSERT_EQ(commands().size(), 1U);
  const auto set = std::get<SetCurrent>(commands()[0]);
  EXPECT_NEAR(set.current.velocity.x(), 1.5, 1e-12);  // sine and cosine round
  EXPECT_EQ(set.ramp_seconds, 60.0);
  EXPECT_EQ(set.current.shear, CurrentShear::kSeventhPower);
  EXPECT_EQ(set.current.depth, 20.0);
  EXPECT_EQ(set.current.relaxation, 5.0);
  EXPECT_EQ(ask({"current", "--velocity", "-1", "0.5"}).code, 0);
  EXPECT_EQ(std::get<SetCurrent>(commands()[1]).current.velocity, Eigen::Vector3d(-1.0, 0.5, 0.0));
  EXPECT_EQ(ask({"current", "--off"}).code, 0);
  EXPECT_TRUE(std::holds_alternative<ClearCurrent>(commands()[2]));
}

TEST_F(CtlSchedule, SaysWhatIsMissingFromACurrent) {
  EXPECT_EQ(ask({"current"}).code, 2);
  EXPECT_THAT(ask({"current", "--at", "5"}).err, HasSubstr("say what to change"));
  EXPECT_THAT(ask({"current", "--off", "--speed", "1"}).err, HasSubstr("--off stands alone"));
  EXPECT_EQ(ask({"current", "--speed", "1", "--to", "90", "--shear", "cubic"}).code, 2);
}

TEST_F(CtlSchedule, GivesCommandsATime) {
  EXPECT_EQ(ask({"wind", "--speed", "12", "--from", "270", "--at", "60"}).out, "scheduled as 1\n");
  EXPECT_EQ(ask({"pause", "--at", "90", "--json"}).out, "{\"ok\":true,\"scheduled_id\":2}\n");
  ASSERT_EQ(scheduled().size(), 2U);
  EXPECT_EQ(scheduled()[0].at, 60.0);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(scheduled()[1].command));
}

TEST_F(CtlSchedule, GivesAnyCommandAsText) {
  EXPECT_EQ(ask({"command", "set_current { current { speed: 1 to_deg: 0 } }", "--at", "30"}).code, 0);
  ASSERT_EQ(scheduled().size(), 1U);
  EXPECT_EQ(std::get<SetCurrent>(scheduled()[0].command).current.velocity.y(), 1.0);
  const Outcome unknown = ask({"command", "set_wnd { }"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("unknown field"), HasSubstr("set_wind")));
  EXPECT_EQ(ask({"command", "set_wind {"}).code, 2);
}

TEST_F(CtlSchedule, ListsAndCancels) {
  EXPECT_EQ(ask({"schedule"}).out, "nothing is scheduled\n");
  ask({"pause", "--at", "90"});
  EXPECT_THAT(ask({"schedule"}).out, AllOf(HasSubstr("90.000 s"), HasSubstr("pause"), HasSubstr("station 127.0.0.1")));
  const auto json = nlohmann::json::parse(ask({"schedule", "--json"}).out);
  EXPECT_EQ(json["command"][0]["id"], 1);
  EXPECT_EQ(ask({"cancel", "1"}).code, 0);
  EXPECT_TRUE(scheduled().empty());
  EXPECT_EQ(ask({"cancel", "1"}).code, 1);
  EXPECT_EQ(ask({"cancel"}).code, 2);
}

TEST_F(CtlSchedule, ListsNumbersWithSevenDigits) {
  ask({"current", "--speed", "1", "--to", "90", "--ramp", "0.30000000000000004", "--at", "30"});
  EXPECT_THAT(ask({"schedule"}).out, AllOf(HasSubstr("ramp: 0.3 "), Not(HasSubstr("e-17"))));
  status_.scheduled = 1;
  EXPECT_THAT(ask({"status"}).out, HasSubstr("schedule   1 command waits\n"));
}

TEST_F(CtlSchedule, PrintsTheCurrent) {
  status_.current = CurrentSettings{current_velocity(1.5, 90.0), CurrentShear::kNone, 0.0, 10.0};
  EXPECT_THAT(ask({"status"}).out, HasSubstr("current    1.50 m/s to 090, carries only what drifts"));
}

}  // namespace
}  // namespace pelagos
