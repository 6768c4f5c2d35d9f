#include <limits>

#include "control_fixture.hpp"
#include "values/beaufort.hpp"

namespace pelagos {
namespace {

using test::Error;
using test::RawStation;
using test::Request;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ControlCommands : public test::ControlTest {
 protected:
  proto::v1::Response ask(const Request& request) {
    if (!station_) station_ = std::make_unique<RawStation>(port());
    const auto reply = station_->ask(request);
    EXPECT_TRUE(reply && reply->has_response());
    return reply ? reply->response() : proto::v1::Response();
  }
  proto::v1::Response set_wind(const proto::v1::Wind& wind, double ramp = 0.0) {
    Request request;
    request.set_id(5);
    *request.mutable_command()->mutable_set_wind()->mutable_wind() = wind;
    if (ramp != 0.0) request.mutable_command()->mutable_set_wind()->set_ramp(ramp);
    return ask(request);
  }
  SetWind last_wind() {
    const auto all = commands();
    EXPECT_FALSE(all.empty());
    const auto* wind = all.empty() ? nullptr : std::get_if<SetWind>(&all.back());
    EXPECT_NE(wind, nullptr);
    return wind == nullptr ? SetWind{} : *wind;
  }

 private:
  std::unique_ptr<RawStation> station_;
};

constexpr double kRounding = 1e-12;  // sines and cosines of degrees

TEST_F(ControlCommands, HelloTellsVersionsAndScene) {
  Request request;
  request.set_id(1);
  request.mutable_hello()->set_protocol_version(1);
  request.mutable_hello()->set_station("desk\n2");
  const auto reply = ask(request);
  EXPECT_EQ(reply.id(), 1u);
  EXPECT_EQ(reply.hello().protocol_version(), 1u);
  EXPECT_EQ(reply.hello().scene(), "test");
  EXPECT_THAT(log(), HasSubstr("calls itself \"desk?2\""));  // no forged lines in the log

  request.mutable_hello()->set_protocol_version(9);
  EXPECT_EQ(ask(request).error().code(), Error::UNSUPPORTED_VERSION);
  expect_unharmed();
}

TEST_F(ControlCommands, StatusCarriesEveryField) {
  ServerStatus& s = status_;
  s.step = 1;
  s.frame = 2;
  s.simulation_time = 3.5;
  s.paused = true;
  s.real_time_factor = 0.9;
  s.achievable_real_time_factor = 1.9;
  s.step_ms = 7.5;
  s.time_step = 0.02;
  s.particles = 100;
  s.boundary_particles = 200;
  s.published_particles = 50;
  s.density_error = 1e-4;
  s.largest_density = 1.01;
  s.density_iterations = 3.5;
  s.divergence_iterations = 1.5;
  s.kinetic_energy = 1e6;
  s.largest_speed = 4.5;
  s.frames_published = 11;
  s.frames_dropped = 12;
  s.poses_accepted = 13;
  s.poses_refused = 14;
  s.poses_corrected = 17;
  s.pose_refusals = {{"a reason", 14}};
  s.open_links = {{"control 0.0.0.0:1", "everybody"}};
  s.unconverged_steps = 15;
  s.recoveries = 16;
  s.effort = {0.005, 3e-4, 1e-3};
  s.governed = s.over_budget = true;
  s.wind = WindSettings{wind_velocity(12.0, 270.0), 2.0, 5.0, 1.25, WindPulse{8.0, 3.0}, WindLaw::kStress, 5e-4};
  BodyState body;
  body.body = 1;
  body.position = {1.0, 2.0, 3.0};
  body.orientation = Eigen::AngleAxisd(-0.5 * EIGEN_PI, Eigen::Vector3d::UnitZ());  // x forward to south
  body.velocity = {3.0, 4.0, 0.0};
  body.health = PoseHealth::kCoasting;
  body.pose_age = 0.25;
  s.bodies = {body};

  Request request;
  request.mutable_get_status();
  const auto m = ask(request).status();
  EXPECT_EQ(m.step(), 1u);
  EXPECT_EQ(m.frame(), 2u);
  EXPECT_EQ(m.simulation_time(), 3.5);
  EXPECT_TRUE(m.paused());
  EXPECT_EQ(m.real_time_factor(), 0.9);
  EXPECT_EQ(m.achievable_real_time_factor(), 1.9);
  EXPECT_EQ(m.step_ms(), 7.5);
  EXPECT_EQ(m.time_step(), 0.02);
  EXPECT_EQ(m.particles(), 100u);
  EXPECT_EQ(m.boundary_particles(), 200u);
  EXPECT_EQ(m.published_particles(), 50u);
  EXPECT_EQ(m.density_error(), 1e-4);
  EXPECT_EQ(m.largest_density(), 1.01);
  EXPECT_EQ(m.density_iterations(), 3.5);
  EXPECT_EQ(m.divergence_iterations(), 1.5);
  EXPECT_EQ(m.kinetic_energy(), 1e6);
  EXPECT_EQ(m.largest_speed(), 4.5);
  EXPECT_EQ(m.frames_published(), 11u);
  EXPECT_EQ(m.frames_dropped(), 12u);
  EXPECT_EQ(m.poses_accepted(), 13u);
  EXPECT_EQ(m.poses_refused(), 14u);
  EXPECT_EQ(m.poses_corrected(), 17u);
  ASSERT_EQ(m.pose_refusals_size(), 1);
  EXPECT_EQ(m.pose_refusals(0).reason(), "a reason");
  EXPECT_EQ(m.pose_refusals(0).count(), 14u);
  ASSERT_EQ(m.open_link_size(), 1);
  EXPECT_EQ(m.open_link(0).link(), "control 0.0.0.0:1");
  EXPECT_EQ(m.open_link(0).reach(), "everybody");
  EXPECT_EQ(m.unconverged_steps(), 15u);
  EXPECT_EQ(m.recoveries(), 16u);
  EXPECT_EQ(m.max_step(), 0.005);
  EXPECT_EQ(m.density_tolerance(), 3e-4);
  EXPECT_EQ(m.divergence_tolerance(), 1e-3);
  EXPECT_TRUE(m.governed());
  EXPECT_TRUE(m.over_budget());
  EXPECT_EQ(m.stations(), 1u);
  EXPECT_NEAR(m.wind().speed(), 12.0, kRounding);
  EXPECT_NEAR(m.wind().from_deg(), 270.0, 1e-9);
  EXPECT_NEAR(m.wind().velocity().x(), 12.0, kRounding);
  EXPECT_EQ(m.wind().amplitude(), 2.0);
  EXPECT_EQ(m.wind().length(), 5.0);
  EXPECT_EQ(m.wind().beta(), 1.25);
  EXPECT_EQ(m.wind().pulse().period(), 8.0);
  EXPECT_EQ(m.wind().pulse().width(), 3.0);
  EXPECT_EQ(m.wind().law(), proto::v1::Wind::STRESS);
  EXPECT_EQ(m.wind().roughness(), 5e-4);
  ASSERT_EQ(m.body_size(), 1);
  EXPECT_EQ(m.body(0).id(), 1u);
  EXPECT_EQ(m.body(0).position().z(), 3.0);
  EXPECT_NEAR(m.body(0).heading_deg(), 180.0, 1e-9);
  EXPECT_EQ(m.body(0).speed(), 5.0);
  EXPECT_EQ(m.body(0).health(), proto::v1::BodyStatus::COASTING);
  EXPECT_EQ(m.body(0).pose_age(), 0.25);
}

TEST_F(ControlCommands, PauseResumeStepAndClearWindArrive) {
  Request request;
  request.mutable_command()->mutable_pause();
  EXPECT_TRUE(ask(request).has_accepted());
  request.mutable_command()->mutable_step()->set_steps(7);
  EXPECT_TRUE(ask(request).has_accepted());
  request.mutable_command()->mutable_step()->clear_steps();
  EXPECT_TRUE(ask(request).has_accepted());
  request.mutable_command()->mutable_resume();
  EXPECT_TRUE(ask(request).has_accepted());
  request.mutable_command()->mutable_clear_wind();
  EXPECT_TRUE(ask(request).has_accepted());
  const auto all = commands();
  ASSERT_EQ(all.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(all[0]));
  EXPECT_EQ(std::get<StepSimulation>(all[1]).steps, 7u);
  EXPECT_EQ(std::get<StepSimulation>(all[2]).steps, 1u);
  EXPECT_TRUE(std::holds_alternative<ResumeSimulation>(all[3]));
  EXPECT_TRUE(std::holds_alternative<ClearWind>(all[4]));
}

/// What docs/control.md shows to those who write a station of their own.
TEST_F(ControlCommands, TheBytesOfTheDocumentationPause) {
  RawStation station(port());
  station.send_bytes(std::string("\0\0\0\x06\x08\x01\x5a\x02\x32\0", 10));
  const auto reply = station.read();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().id(), 1u);
  EXPECT_TRUE(reply->response().has_accepted());
  ASSERT_EQ(commands().size(), 1u);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(commands()[0]));
}

TEST_F(ControlCommands, WindInEachOfItsThreeForms) {
  proto::v1::Wind wind;
  wind.set_speed(12.0);
  wind.set_from_deg(270.0);
  EXPECT_TRUE(set_wind(wind, 5.0).has_accepted());
  EXPECT_TRUE(last_wind().wind.velocity->isApprox(Eigen::Vector3d(12.0, 0.0, 0.0), kRounding));
  EXPECT_EQ(last_wind().ramp_seconds, 5.0);

  wind.clear_speed();
  wind.set_beaufort(7);
  EXPECT_TRUE(set_wind(wind).has_accepted());
  EXPECT_NEAR(last_wind().wind.velocity->x(), beaufort_speed(7), kRounding);
  EXPECT_EQ(last_wind().ramp_seconds, 0.0);

  wind.Clear();
  wind.mutable_velocity()->set_x(-18.0);
  wind.mutable_velocity()->set_y(-0.5);
  wind.set_amplitude(3.0);
  wind.set_beta(1.5);
  wind.set_length(2.0);
  wind.mutable_pulse()->set_period(10.0);
  wind.mutable_pulse()->set_width(4.0);
  EXPECT_TRUE(set_wind(wind).has_accepted());
  EXPECT_EQ(last_wind().wind.velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));
  EXPECT_EQ(last_wind().wind.amplitude, 3.0);
  EXPECT_EQ(last_wind().wind.length, 2.0);
  ASSERT_TRUE(last_wind().wind.pulse);
  EXPECT_EQ(last_wind().wind.pulse->width, 4.0);
}

TEST_F(ControlCommands, WindChangesItsLawWithItsOwnRoughness) {
  status_.wind = WindSettings{wind_velocity(8.0, 90.0), 2.0, 5.0, 1.25, WindPulse{8.0, 3.0}};
  proto::v1::Wind wind;
  wind.set_law(proto::v1::Wind::PAPER);
  const auto refused = set_wind(wind);  // the pulse in seconds would become one in steps
  EXPECT_EQ(refused.error().field(), "command.set_wind.wind.law");
  EXPECT_THAT(refused.error().message(), testing::HasSubstr("a pulse, or clear_pulse"));
  wind.mutable_pulse()->set_period(10.0);
  wind.mutable_pulse()->set_width(100.0);
  EXPECT_TRUE(set_wind(wind).has_accepted());
  EXPECT_EQ(last_wind().wind.law, WindLaw::kPaper);
  EXPECT_EQ(last_wind().wind.roughness, 0.01);
  wind.Clear();
  wind.set_speed(10.0);
  EXPECT_TRUE(set_wind(wind).has_accepted());
  EXPECT_EQ(last_wind().wind.law, WindLaw::kPaper) << "what is left out stays";
}

TEST_F(ControlCommands, WindKeepsWhatIsLeftOut) {
  status_.wind = WindSettings{wind_velocity(8.0, 90.0), 2.0, 5.0, 1.25, WindPulse{8.0, 3.0}};  // the scene's
  proto::v1::Wind wind;
  wind.set_speed(16.0);
  EXPECT_TRUE(set_wind(wind).has_accepted());
  EXPECT_TRUE(last_wind().wind.velocity->isApprox(wind_velocity(16.0, 90.0), kRounding));
  EXPECT_EQ(last_wind().wind.amplitude, 2.0);
  EXPECT_EQ(last_wind().wind.length, 5.0);
  EXPECT_EQ(last_wind().wind.beta, 1.25);
  EXPECT_TRUE(last_wind().wind.pulse);

  wind.Clear();
  wind.set_from_deg(180.0);  // keeps the 16 m/s last set, not the 8 m/s that still blow
  EXPECT_TRUE(set_wind(wind).has_accepted());
  EXPECT_TRUE(last_wind().wind.velocity->isApprox(wind_velocity(16.0, 180.0), kRounding));

  Request request;
  request.mutable_command()->mutable_set_wind()->set_clear_pulse(true);
  EXPECT_TRUE(ask(request).has_accepted());
  EXPECT_FALSE(last_wind().wind.pulse);
  EXPECT_TRUE(last_wind().wind.velocity->isApprox(wind_velocity(16.0, 180.0), kRounding));

  request.mutable_command()->mutable_clear_wind();
  EXPECT_TRUE(ask(request).has_accepted());
  EXPECT_EQ(set_wind(wind).error().code(), Error::INVALID_VALUE);  // a direction alone, of no wind
}

struct BadWind {
  const char* name;
  std::function<void(proto::v1::SetWind&)> make;
  const char* field;
  const char* says;
};
void PrintTo(const BadWind& bad, std::ostream* out) { *out << bad.name; }

class ControlRefusals : public ControlCommands, public testing::WithParamInterface<BadWind> {};

TEST_P(ControlRefusals, NameFieldValueAndWhatIsAllowed) {
  Request request;
  request.set_id(9);
  GetParam().make(*request.mutable_command()->mutable_set_wind());
  const auto reply = ask(request);
  EXPECT_EQ(reply.id(), 9u);
  EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE);
  EXPECT_EQ(reply.error().field(), GetParam().field);
  EXPECT_THAT(reply.error().message(), HasSubstr(GetParam().says));
  EXPECT_TRUE(commands().empty());
  EXPECT_EQ(server().statistics().invalid, 1u);
  expect_unharmed();
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

proto::v1::Wind& westerly(proto::v1::SetWind& set) {
  set.mutable_wind()->set_speed(5.0);
  set.mutable_wind()->set_from_deg(270.0);
  return *set.mutable_wind();
}

INSTANTIATE_TEST_SUITE_P(
    Values, ControlRefusals,
    testing::Values(
        BadWind{"Nothing", [](auto&) {}, "command.set_wind.wind", "exactly one of speed"},
        BadWind{"SpeedHigh", [](auto& s) { westerly(s).set_speed(200); }, "command.set_wind.wind.speed",
                "200 is out of range"},
        BadWind{"SpeedNegative", [](auto& s) { westerly(s).set_speed(-1); }, "command.set_wind.wind.speed",
                "0 to 75 m/s"},
        BadWind{"SpeedNan", [](auto& s) { westerly(s).set_speed(kNan); }, "command.set_wind.wind.speed", "nan"},
        BadWind{"Direction", [](auto& s) { westerly(s).set_from_deg(-10); }, "command.set_wind.wind.from_deg",
                "0 to 360"},
        BadWind{"DirectionInf", [](auto& s) { westerly(s).set_from_deg(kInfinity); }, "command.set_wind.wind.from_deg",
                "inf"},
        BadWind{"NoDirection", [](auto& s) { s.mutable_wind()->set_beaufort(4); }, "command.set_wind.wind.from_deg",
                "missing"},
        BadWind{"TwoWays", [](auto& s) { westerly(s).set_beaufort(4); }, "command.set_wind.wind", "more than one way"},
        BadWind{"Beaufort",
                [](auto& s) {
                  s.mutable_wind()->set_beaufort(99);
                  s.mutable_wind()->set_from_deg(0);
                },
                "command.set_wind.wind.beaufort", "0 to 12"},
        BadWind{"Velocity", [](auto& s) { s.mutable_wind()->mutable_velocity()->set_z(kNan); },
                "command.set_wind.wind.velocity.z", "nan"},
        BadWind{"Amplitude", [](auto& s) { westerly(s).set_amplitude(-3); }, "command.set_wind.wind.amplitude",
                "0 to 30"},
        BadWind{"Length", [](auto& s) { westerly(s).set_length(0); }, "command.set_wind.wind.length", "0.01 to 10000"},
        BadWind{"Beta", [](auto& s) { westerly(s).set_beta(1e9); }, "command.set_wind.wind.beta", "0 to 100"},
        BadWind{"Pulse",
                [](auto& s) {
                  auto& p = *westerly(s).mutable_pulse();
                  p.set_period(2);
                  p.set_width(3);
                },
                "command.set_wind.wind.pulse.width", "longer than the period"},
        BadWind{"PulseTwice",
                [](auto& s) {
                  westerly(s).mutable_pulse()->set_period(2);
                  s.set_clear_pulse(true);
                  s.mutable_wind()->mutable_pulse()->set_width(1);
                },
                "command.set_wind.clear_pulse", "allowed: one of them"},
        BadWind{"Ramp",
                [](auto& s) {
                  westerly(s);
                  s.set_ramp(-1);
                },
                "command.set_wind.ramp", "0 to 3600 s"},
        BadWind{"RampNan",
                [](auto& s) {
                  westerly(s);
                  s.set_ramp(kNan);
                },
                "command.set_wind.ramp", "nan"}),
    [](const auto& entry) { return entry.param.name; });

TEST_F(ControlCommands, RefusesStepsOutOfRange) {
  for (const std::uint32_t steps : {0u, 10001u, 4294967295u}) {
    Request request;
    request.mutable_command()->mutable_step()->set_steps(steps);
    const auto reply = ask(request);
    EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE);
    EXPECT_THAT(reply.error().message(), AllOf(StartsWith("command.step.steps: "), HasSubstr("1 to 10000")));
  }
  EXPECT_TRUE(commands().empty());
}

TEST_F(ControlCommands, NotesFieldsThatItDoesNotKnow) {
  Request request;
  auto& wind = westerly(*request.mutable_command()->mutable_set_wind());
  wind.GetReflection()->MutableUnknownFields(&wind)->AddVarint(123, 1);
  EXPECT_THAT(ask(request).error().message(), HasSubstr("field number 123"));
}

TEST_F(ControlCommands, AnswersRequestsOfNoKnownKind) {
  Request request;
  request.set_id(3);
  const auto reply = ask(request);
  EXPECT_EQ(reply.id(), 3u);
  EXPECT_EQ(reply.error().code(), Error::UNKNOWN_REQUEST);
  expect_unharmed();
}

TEST_F(ControlCommands, PassesOnWhyTheSimulationRefuses) {
  refusal_ = "only while paused";
  Request request;
  request.mutable_command()->mutable_step();
  const auto reply = ask(request);
  EXPECT_EQ(reply.error().code(), Error::REFUSED);
  EXPECT_EQ(reply.error().message(), "only while paused");
}

TEST_F(ControlCommands, AreAnsweredFromTheBoundaryInTheOrderOfTheRequests) {
  holds_answers_ = true;
  RawStation station(port());
  Request pause, status, clear;
  pause.set_id(1);
  pause.mutable_command()->mutable_pause();
  status.set_id(2);
  status.mutable_get_status();
  clear.set_id(3);
  clear.mutable_command()->mutable_set_wind()->mutable_wind()->set_speed(3.0);  // of no direction
  for (const Request& request : {pause, status, clear}) station.send(request);
  ASSERT_TRUE(eventually([&] { return release_answer(); }));
  const auto first = station.read(), second = station.read();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->response().id(), 1u);
  EXPECT_EQ(first->response().accepted().step(), kStep);
  EXPECT_EQ(second->response().id(), 2u) << "held back by the command before it";
  EXPECT_TRUE(second->response().has_status());
  ASSERT_TRUE(eventually([&] { return release_answer(); }));
  const auto third = station.read();
  ASSERT_TRUE(third);
  EXPECT_EQ(third->response().error().field(), "command.set_wind.wind.from_deg");
}

/// A station that ends its side after a command still reads what became of it.
TEST_F(ControlCommands, AreAnsweredAfterTheStationHasSentItsLast) {
  holds_answers_ = true;
  RawStation station(port());
  Request pause;
  pause.set_id(4);
  pause.mutable_command()->mutable_pause();
  station.send(pause);
  station.end_sending();
  ASSERT_TRUE(eventually([&] { return release_answer(); }));
  const auto reply = station.read();
  ASSERT_TRUE(reply);
  EXPECT_TRUE(reply->response().has_accepted());
}

TEST_F(ControlCommands, OutlivesAHookThatThrows) {
  throws_ = true;
  Request request;
  request.mutable_command()->mutable_pause();
  EXPECT_EQ(ask(request).error().code(), Error::INTERNAL);
  expect_unharmed();
}

}  // namespace
}  // namespace pelagos
