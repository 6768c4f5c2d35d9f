// Commands with a time, and the current, over the link.

#include <limits>

#include "control_fixture.hpp"

namespace pelagos {
namespace {

using test::Error;
using test::RawStation;
using test::Request;
using testing::AllOf;
using testing::HasSubstr;

class ControlSchedule : public test::ControlTest {
 protected:
  proto::v1::Response ask(const Request& request) {
    if (!station_) station_ = std::make_unique<RawStation>(port());
    const auto reply = station_->ask(request);
    EXPECT_TRUE(reply && reply->has_response());
    return reply ? reply->response() : proto::v1::Response();
  }
  static Request at(double time) {
    Request request;
    request.mutable_command()->set_at(time);
    return request;
  }
  static Request westerly_at(double time) {
    Request request = at(time);
    proto::v1::Wind& wind = *request.mutable_command()->mutable_set_wind()->mutable_wind();
    wind.set_speed(12.0);
    wind.set_from_deg(270.0);
    return request;
  }
  static Request cancel(std::uint64_t id) {
    Request request;
    request.mutable_cancel_scheduled()->set_id(id);
    return request;
  }

 private:
  std::unique_ptr<RawStation> station_;
};

TEST_F(ControlSchedule, TakesACommandWithATimeAndTellsItsId) {
  const auto first = ask(westerly_at(60.0));
  ASSERT_TRUE(first.has_accepted());
  EXPECT_EQ(first.accepted().scheduled_id(), 1U);
  Request pause = at(90.5);
  pause.mutable_command()->mutable_pause();
  EXPECT_EQ(ask(pause).accepted().scheduled_id(), 2U);
  ASSERT_EQ(scheduled().size(), 2U);
  EXPECT_EQ(scheduled()[0].at, 60.0);
  EXPECT_EQ(std::get<SetWind>(scheduled()[0].command).wind.speed, 12.0);
  EXPECT_EQ(scheduled()[1].at, 90.5);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(scheduled()[1].command));
  EXPECT_TRUE(commands().empty());
}

TEST_F(ControlSchedule, ACommandWithoutATimeIsForTheNextBoundary) {
  Request request;
  request.mutable_command()->mutable_pause();
  const auto reply = ask(request);
  ASSERT_TRUE(reply.has_accepted());
  EXPECT_FALSE(reply.accepted().has_scheduled_id());
  ASSERT_EQ(commands().size(), 1U);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(commands()[0]));
}

TEST_F(ControlSchedule, ListsWhatWaitsAsItWasGiven) {
  ask(westerly_at(60.0));
  Request request;
  request.mutable_get_schedule();
  const auto reply = ask(request);
  ASSERT_EQ(reply.schedule().command_size(), 1);
  const auto& waiting = reply.schedule().command(0);
  EXPECT_EQ(waiting.id(), 1U);
  EXPECT_EQ(waiting.command().at(), 60.0);
  EXPECT_THAT(waiting.command().source(), HasSubstr("station 127.0.0.1:"));
  EXPECT_EQ(waiting.command().set_wind().wind().speed(), 12.0);
  EXPECT_EQ(waiting.command().set_wind().wind().from_deg(), 270.0);
  EXPECT_FALSE(waiting.command().set_wind().wind().has_amplitude());
}

TEST_F(ControlSchedule, CancelsOnce) {
  ask(westerly_at(60.0));
  EXPECT_TRUE(ask(cancel(1)).has_accepted());
  EXPECT_TRUE(scheduled().empty());
  const auto again = ask(cancel(1));
  EXPECT_EQ(again.error().code(), Error::INVALID_VALUE);
  EXPECT_EQ(again.error().field(), "cancel_scheduled.id");
  EXPECT_THAT(again.error().message(), HasSubstr("1 is not waiting"));
  Request nameless;
  nameless.mutable_cancel_scheduled();
  EXPECT_THAT(ask(nameless).error().message(), HasSubstr("is missing"));
}

TEST_F(ControlSchedule, RefusesATimeThatHasPassedNamingThePresent) {
  now_ = 61.25;
  const auto reply = ask(westerly_at(60.0));
  EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE);
  EXPECT_EQ(reply.error().field(), "command.at");
  EXPECT_THAT(reply.error().message(), AllOf(HasSubstr("60 s has passed"), HasSubstr("61.25 s")));
  EXPECT_TRUE(ask(westerly_at(61.25)).has_accepted());
}

TEST_F(ControlSchedule, PassesOnThatTooManyWait) {
  refusal_ = "too many commands wait";
  const auto reply = ask(westerly_at(60.0));
  EXPECT_EQ(reply.error().code(), Error::REFUSED);
  EXPECT_EQ(reply.error().message(), "too many commands wait");
}

TEST_F(ControlSchedule, RefusesTimesThatAreNone) {
  for (const double time :
       {-1.0, 1e10, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto reply = ask(westerly_at(time));
    EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE) << time;
    EXPECT_EQ(reply.error().field(), "command.at") << time;
  }
  EXPECT_TRUE(scheduled().empty());
  expect_unharmed();
}

TEST_F(ControlSchedule, RefusesWhatHasNoMeaningWithATime) {
  Request resume = at(60.0);
  resume.mutable_command()->mutable_resume();
  EXPECT_THAT(ask(resume).error().message(), AllOf(HasSubstr("command.resume"), HasSubstr("without a time")));
  Request step = at(60.0);
  step.mutable_command()->mutable_step();
  EXPECT_EQ(ask(step).error().field(), "command.step");
  Request nothing = at(60.0);
  EXPECT_THAT(ask(nothing).error().message(), HasSubstr("no command"));
}

TEST_F(ControlSchedule, RefusesWhatIsTheServersOwn) {
  Request effort;
  effort.mutable_command()->mutable_set_effort()->set_max_step(1.0);
  EXPECT_THAT(ask(effort).error().message(), HasSubstr("command logs only"));
  Request step = westerly_at(60.0);
  step.mutable_command()->set_before_step(7);
  EXPECT_EQ(ask(step).error().field(), "command.before_step");
  Request source = westerly_at(60.0);
  source.mutable_command()->set_source("me");
  EXPECT_EQ(ask(source).error().field(), "command.source");
}

TEST_F(ControlSchedule, NamesFaultsInsideACommandByTheirWholePath) {
  Request request = westerly_at(60.0);
  request.mutable_command()->mutable_set_wind()->mutable_wind()->set_speed(200.0);
  EXPECT_EQ(ask(request).error().field(), "command.set_wind.wind.speed");
}

// ---- the current

class ControlCurrent : public ControlSchedule {
 protected:
  proto::v1::Response set_current(const proto::v1::Current& current, double ramp = 0.0) {
    Request request;
    *request.mutable_command()->mutable_set_current()->mutable_current() = current;
    request.mutable_command()->mutable_set_current()->set_ramp(ramp);
    return ask(request);
  }
  SetCurrent last() {
    const auto all = commands();
    const auto* set = all.empty() ? nullptr : std::get_if<SetCurrent>(&all.back());
    EXPECT_NE(set, nullptr);
    return set == nullptr ? SetCurrent{} : *set;
  }
};

TEST_F(ControlCurrent, ArrivesInBothItsForms) {
  proto::v1::Current current;
  current.set_speed(1.5);
  current.set_to_deg(90.0);
  EXPECT_TRUE(set_current(current, 30.0).has_accepted());
  EXPECT_TRUE(last().current.velocity.isApprox(Eigen::Vector3d(1.5, 0.0, 0.0), 1e-12));  // sine and cosine round
  EXPECT_EQ(last().ramp_seconds, 30.0);
  EXPECT_EQ(last().current.shear, CurrentShear::kNone);

  current.Clear();
  current.mutable_velocity()->set_y(-2.0);
  current.set_shear(proto::v1::Current::SEVENTH_POWER);
  current.set_depth(25.0);
  current.set_relaxation(4.0);
  EXPECT_TRUE(set_current(current).has_accepted());
  EXPECT_EQ(last().current.velocity, Eigen::Vector3d(0.0, -2.0, 0.0));
  EXPECT_EQ(last().current.shear, CurrentShear::kSeventhPower);
  EXPECT_EQ(last().current.depth, 25.0);
  EXPECT_EQ(last().current.relaxation, 4.0);

  Request clear;
  clear.mutable_command()->mutable_clear_current();
  EXPECT_TRUE(ask(clear).has_accepted());
  EXPECT_TRUE(std::holds_alternative<ClearCurrent>(commands().back()));
}

struct BadCurrent {
  const char* name;
  std::function<void(proto::v1::Current&)> make;  ///< of 1 m/s to the east
  const char* field;
  const char* says;
};
void PrintTo(const BadCurrent& bad, std::ostream* out) { *out << bad.name; }

class ControlCurrentRefusals : public ControlCurrent, public testing::WithParamInterface<BadCurrent> {};

TEST_P(ControlCurrentRefusals, NameFieldValueAndWhatIsAllowed) {
  proto::v1::Current current;
  current.set_speed(1.0);
  current.set_to_deg(90.0);
  GetParam().make(current);
  const auto reply = set_current(current);
  EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE);
  EXPECT_EQ(reply.error().field(), std::string("command.set_current.current") + GetParam().field);
  EXPECT_THAT(reply.error().message(), HasSubstr(GetParam().says));
  EXPECT_TRUE(commands().empty());
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Values, ControlCurrentRefusals,
    testing::Values(BadCurrent{"SpeedHigh", [](auto& c) { c.set_speed(10.1); }, ".speed", "allowed: 0 to 10 m/s"},
                    BadCurrent{"SpeedNegative", [](auto& c) { c.set_speed(-1); }, ".speed", "-1 is out of range"},
                    BadCurrent{"SpeedNan", [](auto& c) { c.set_speed(kNan); }, ".speed", "nan"},
                    BadCurrent{"Direction", [](auto& c) { c.set_to_deg(361); }, ".to_deg", "0 to 360"},
                    BadCurrent{"NoDirection", [](auto& c) { c.clear_to_deg(); }, ".to_deg", "is missing"},
                    BadCurrent{"Nothing", [](auto& c) { c.Clear(); }, "", "exactly one of speed"},
                    BadCurrent{"TwoWays", [](auto& c) { c.mutable_velocity(); }, "", "more than one way"},
                    BadCurrent{"Long",
                               [](auto& c) {
                                 c.Clear();
                                 c.mutable_velocity()->set_x(8);
                                 c.mutable_velocity()->set_y(8);
                               },
                               ".velocity", "allowed: 0 to 10 m/s"},
                    BadCurrent{"Upward",
                               [](auto& c) {
                                 c.Clear();
                                 c.mutable_velocity()->set_z(1);
                               },
                               ".velocity", "x and y only"},
                    BadCurrent{"NoDepth", [](auto& c) { c.set_shear(proto::v1::Current::LINEAR); }, ".depth",
                               "is missing"},
                    BadCurrent{"DepthAlone", [](auto& c) { c.set_depth(5); }, ".depth", "no meaning without shear"},
                    BadCurrent{"DepthZero",
                               [](auto& c) {
                                 c.set_shear(proto::v1::Current::LINEAR);
                                 c.set_depth(0);
                               },
                               ".depth", "0.01 to 11000 m"},
                    BadCurrent{"DepthNegative",
                               [](auto& c) {
                                 c.set_shear(proto::v1::Current::SEVENTH_POWER);
                                 c.set_depth(-3);
                               },
                               ".depth", "-3 is out of range"},
                    BadCurrent{"Relaxation", [](auto& c) { c.set_relaxation(0); }, ".relaxation", "0.5 to 3600 s"}),
    [](const auto& entry) { return entry.param.name; });

TEST_F(ControlCurrent, NeedsACurrent) {
  Request request;
  request.mutable_command()->mutable_set_current();
  EXPECT_EQ(ask(request).error().field(), "command.set_current.current");
}

TEST_F(ControlCurrent, IsInTheStatus) {
  status_.current = CurrentSettings{current_velocity(1.5, 120.0), CurrentShear::kLinear, 20.0, 10.0};
  status_.moves_water = {true, false};
  status_.scheduled = 3;
  Request request;
  request.mutable_get_status();
  const auto status = ask(request).status();
  EXPECT_NEAR(status.current().speed(), 1.5, 1e-12);
  EXPECT_NEAR(status.current().to_deg(), 120.0, 1e-9);
  EXPECT_EQ(status.current().shear(), proto::v1::Current::LINEAR);
  EXPECT_EQ(status.current().depth(), 20.0);
  EXPECT_TRUE(status.current().moves_water_x());
  EXPECT_FALSE(status.current().moves_water_y());
  EXPECT_EQ(status.scheduled(), 3U);
}

}  // namespace
}  // namespace pelagos
