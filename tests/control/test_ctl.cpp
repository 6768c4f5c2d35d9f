#include <cstdio>
#include <future>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../support/places.hpp"
#include "ctl_test.hpp"
#include "values/beaufort.hpp"

namespace pelagos {
namespace {

using test::Outcome;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Ctl : public test::CtlTest {
 protected:
  SetWind last_wind() {
    const auto all = commands();
    const auto* wind = all.empty() ? nullptr : std::get_if<SetWind>(&all.back());
    EXPECT_NE(wind, nullptr);
    return wind == nullptr ? SetWind{} : *wind;
  }
};

TEST_F(Ctl, PrintsTheStatusForPeople) {
  status_.real_time_factor = 0.98;
  status_.wind = WindSettings{wind_velocity(12.0, 270.0), 2.0, 10.0, 1.5, std::nullopt};
  status_.bodies.push_back({});
  status_.poses_corrected = 3;
  status_.pose_refusals = {{"the time is not later", 2}};
  status_.open_links = {{"DDS domain 7", "everybody can send poses"}};
  const Outcome outcome = ask({"status"});
  EXPECT_THAT(outcome.out, HasSubstr("3 accepted with the velocity of their places"));
  EXPECT_THAT(outcome.out, HasSubstr("2 refused: the time is not later"));
  EXPECT_THAT(outcome.out, HasSubstr("OPEN       DDS domain 7: everybody can send poses"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("scene      test, running"));
  EXPECT_THAT(outcome.out, HasSubstr("0.98 of real time"));
  EXPECT_THAT(outcome.out, HasSubstr("12.0 m/s from 270"));
  EXPECT_THAT(outcome.out, HasSubstr("without poses"));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Ctl, PrintsNotesOnTheStartAndWhatIsInTheHolds) {
  status_.bodies.push_back({});
  status_.bodies.back().body = 3;
  status_.holds = {{3, 5.76, 1.5}};
  status_.start_notes = {"body 3 (lighter): its hold starts dry"};
  const Outcome people = ask({"status"});
  EXPECT_THAT(people.out, HasSubstr("1.5 m^3 of water in its hold of 5.76 m^3"));
  EXPECT_THAT(people.out, HasSubstr("start      body 3 (lighter): its hold starts dry\n"));
  const auto json = nlohmann::json::parse(ask({"status", "--json"}).out);
  EXPECT_EQ(json["start_note"][0], "body 3 (lighter): its hold starts dry");
  EXPECT_EQ(json["body"][0]["water_in_hold"], 1.5);
}

TEST_F(Ctl, PrintsTheStatusForMachines) {
  status_.step = 9007199254740993;  // beyond what a double holds: numbers stay numbers, exactly
  status_.density_error = std::numeric_limits<double>::quiet_NaN();
  const Outcome outcome = ask({"status", "--json"});
  EXPECT_EQ(outcome.code, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["scene"], "test");
  EXPECT_EQ(json["step"].get<std::uint64_t>(), 9007199254740993u);
  EXPECT_TRUE(json["density_error"].is_null());
  EXPECT_EQ(json["paused"], false);
  EXPECT_TRUE(json["body"].is_array());
  EXPECT_FALSE(json.contains("wind"));
}

TEST_F(Ctl, SendsEveryWindOption) {
  EXPECT_EQ(ask({"wind", "--speed", "12", "--from", "270", "--ramp", "5", "--amplitude", "2", "--beta", "1.2",
                 "--length", "7", "--period", "8", "--width", "3"})
                .code,
            0);
  const SetWind command = last_wind();
  EXPECT_NEAR(command.wind.velocity->x(), 12.0, 1e-12);  // sin and cos round
  EXPECT_EQ(command.ramp_seconds, 5.0);
  EXPECT_EQ(command.wind.amplitude, 2.0);
  EXPECT_EQ(command.wind.beta, 1.2);
  EXPECT_EQ(command.wind.length, 7.0);
  ASSERT_TRUE(command.wind.pulse);
  EXPECT_EQ(command.wind.pulse->period, 8.0);
  EXPECT_EQ(command.wind.pulse->width, 3.0);

  EXPECT_EQ(ask({"wind", "--beaufort", "7", "--no-pulse"}).code, 0);  // keeps the direction
  EXPECT_NEAR(last_wind().wind.velocity->x(), 0.836 * std::pow(7.0, 1.5), 1e-9);
  EXPECT_FALSE(last_wind().wind.pulse);

  EXPECT_EQ(ask({"wind", "--velocity", "-18", "-0.5", "0"}).code, 0);
  EXPECT_EQ(last_wind().wind.velocity, Eigen::Vector3d(-18.0, -0.5, 0.0));

  EXPECT_EQ(ask({"wind", "--off"}).code, 0);
  EXPECT_TRUE(std::holds_alternative<ClearWind>(commands().back()));
}

TEST_F(Ctl, PrintsTheWindAtPlaces) {
  status_.simulation_time = 7.5;
  const Outcome people = ask({"wind-at", "12", "-4", "10"});  // negative numbers are no options
  EXPECT_EQ(people.code, 0) << people.err;
  EXPECT_EQ(people.out, "12.65 m/s from 288.4, towards (12.00, -4.00, 0.50) m/s, at 7.500 s\n");
  EXPECT_EQ(ask({"wind-at", "1", "2", "-3"}).out, "0.00 m/s, towards (0.00, 0.00, 0.00) m/s, at 7.500 s\n");

  const Outcome machines = ask({"wind-at", "--json", "-1", "0", "10", "3", "4", "5"});
  EXPECT_EQ(machines.code, 0) << machines.err;
  const auto json = nlohmann::json::parse(machines.out);
  EXPECT_EQ(json["simulation_time"], 7.5);
  ASSERT_EQ(json["place"].size(), 2u);
  EXPECT_EQ(json["place"][0]["velocity"]["x"], -1.0);
  EXPECT_EQ(json["place"][1]["speed"], 5.0);

  EXPECT_EQ(ask({"wind-at", "1", "2"}).code, 2);
  EXPECT_EQ(ask({"wind-at", "1", "2", "3", "4"}).code, 2);
  EXPECT_EQ(ask({"wind-at"}).code, 2);
  EXPECT_THAT(ask({"wind-at", "1e9", "0", "0"}).err, HasSubstr("query_wind.position[0].x: 1000000000 is out of range"));
}

TEST_F(Ctl, PausesStepsAndResumes) {
  EXPECT_EQ(ask({"pause"}).out, "done\n");
  EXPECT_EQ(ask({"step", "10"}).code, 0);
  EXPECT_EQ(ask({"step"}).code, 0);
  EXPECT_EQ(ask({"resume", "--json"}).out, "{\"ok\":true}\n");
  const auto all = commands();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(std::get<StepSimulation>(all[1]).steps, 10u);
  EXPECT_EQ(std::get<StepSimulation>(all[2]).steps, 1u);
}

TEST_F(Ctl, FailsWithTheServersWords) {
  const Outcome outcome = ask({"wind", "--speed", "200", "--from", "0"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("set_wind.wind.speed: 200 is out of range; allowed: 0 to 75 m/s"));
  EXPECT_THAT(outcome.out, IsEmpty());
  const Outcome json = ask({"wind", "--speed", "200", "--from", "0", "--json"});
  EXPECT_EQ(json.code, 1);
  const auto parsed = nlohmann::json::parse(json.out);
  EXPECT_EQ(parsed["ok"], false);
  EXPECT_EQ(parsed["error"]["code"], "INVALID_VALUE");
  EXPECT_EQ(parsed["error"]["field"], "command.set_wind.wind.speed");
}

TEST_F(Ctl, ReadsDecimalNumbersWithLeadingZeros) {
  ASSERT_EQ(ask({"wind", "--beaufort", "010", "--from", "090"}).code, 0);
  const SetWind set = last_wind();
  EXPECT_NEAR(set.wind.velocity->norm(), beaufort_speed(10), 1e-9);
  EXPECT_NEAR(wind_from_deg(*set.wind.velocity), 90.0, 1e-9);
  ASSERT_EQ(ask({"command", "set_wind { wind { beaufort: 08 from_deg: 045 } }"}).code, 0);
  EXPECT_NEAR(wind_from_deg(*last_wind().wind.velocity), 45.0, 1e-9);
}

TEST_F(Ctl, RefusesWhatIsNoNumberItself) {
  for (const char* number : {"nan", "inf", "0,5", "5kn", "0x5", "", "−5"}) {
    const Outcome outcome = ask({"wind", "--speed", number, "--from", "0"});
    EXPECT_EQ(outcome.code, 2) << number;
    EXPECT_THAT(outcome.err, HasSubstr("pelagos-ctl: --speed: is ")) << number;
  }
  EXPECT_THAT(commands(), IsEmpty());
  EXPECT_THAT(test::run_ctl_with({"command", "set_wind { wind { speed: 0,5 } }"}).err,
              HasSubstr("command: character 26: speed: has a comma in the number 0,5; write 0.5"));
}

TEST_F(Ctl, NamesTheWrongWord) {
  EXPECT_THAT(test::run_ctl_with({"stauts"}).err, HasSubstr("unknown command stauts; did you mean status?"));
  EXPECT_THAT(test::run_ctl_with({"release", "hose", "--fom", "1"}).err,
              HasSubstr("unknown option --fom of release; did you mean --from?"));
  EXPECT_THAT(test::run_ctl_with({"status", "--timout", "3"}).err, HasSubstr("did you mean --timeout?"));
}

TEST_F(Ctl, HelpTellsTheLimitsThatHold) {
  EXPECT_THAT(test::run_ctl_with({"current", "--help"}).out, HasSubstr("At the surface, m/s (0 to 10)"));
  EXPECT_THAT(ask({"current", "--speed", "10.1", "--to", "0"}).err, HasSubstr("allowed: 0 to 10 m/s"));
  EXPECT_THAT(test::run_ctl_with({"wind", "--help"}).out, HasSubstr("m/s (0 to 75)"));
}

TEST_F(Ctl, TellsOfACommandLogThatIsNotWritten) {
  status_.command_log = CommandLogState{"run.log", "No space left on device", 3, 0};
  EXPECT_THAT(ask({"status"}).out,
              HasSubstr("record     run.log: NOT WRITTEN, No space left on device; lines that wait for room: 3\n"));
  const auto json = nlohmann::json::parse(ask({"status", "--json"}).out);
  EXPECT_EQ(json["command_log"]["waiting"], 3);
}

TEST_F(Ctl, FollowsEvents) {
  auto following = std::async(std::launch::async, [this, at = port()] {
    return test::run_ctl_with({"--server", "127.0.0.1:" + std::to_string(at), "events", "--count", "3", "--json"});
  });
  // Subscribing takes a moment that cannot be seen from here: go on until three have arrived.
  std::uint64_t sequence = 0;
  while (following.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) {
    ASSERT_LT(sequence, 4000u);
    server().broadcast({++sequence, 1, 0.25, "wind", "server", "changed"});
  }
  const Outcome outcome = following.get();
  EXPECT_EQ(outcome.code, 0);
  std::istringstream lines(outcome.out);
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    ++count;
    EXPECT_EQ(nlohmann::json::parse(line)["kind"], "wind");
  }
  EXPECT_EQ(count, 3);
}

TEST_F(Ctl, SaysWhenTooFewEventsCame) {
  const Outcome outcome = ask({"events", "--count", "2", "--duration", "0.1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("0 of 2 events"));
  EXPECT_EQ(ask({"events", "--duration", "0.1"}).code, 0);
}

TEST_F(Ctl, SaysWhatToDoWhenNobodyListens) {
  const std::uint16_t free_again = port();
  stop();
  const Outcome outcome = test::run_ctl_with({"--server", "127.0.0.1:" + std::to_string(free_again), "status"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is pelagos-server running at 127.0.0.1:" + std::to_string(free_again)));
  EXPECT_THAT(outcome.err, HasSubstr("Start it with: pelagos-server --scene"));
}

/// A listener that accepts (by its backlog) and then does whatever is asked of it.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* generic = static_cast<sockaddr*>(static_cast<void*>(&address));
    EXPECT_EQ(::bind(socket_, generic, sizeof address), 0);
    EXPECT_EQ(::listen(socket_, 5), 0);
    socklen_t size = sizeof address;
    ::getsockname(socket_, generic, &size);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { ::close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  void answer(const std::string& bytes) const {
    const int peer = ::accept(socket_, nullptr, nullptr);
    char request[256];
    EXPECT_GT(::recv(peer, request, sizeof request, 0), 0);
    EXPECT_EQ(::send(peer, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
    ::close(peer);
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

TEST(CtlAlone, GivesUpOnAServerThatDoesNotAnswer) {
  const Listener silent;
  const Outcome outcome = test::run_ctl_with({"--server", silent.address(), "--timeout", "0.2", "status"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("did not answer within 0.2 s"));
}

TEST(CtlAlone, SaysWhenSomethingElseAnswers) {
  const Listener other;
  std::thread web([&] { other.answer("HTTP/1.1 400 Bad Request\r\n\r\n"); });
  const Outcome outcome = test::run_ctl_with({"--server", other.address(), "status"});
  web.join();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("does not speak the Pelagos control protocol"));
}

TEST(CtlAlone, RefusesWrongCommandLines) {
  const std::vector<std::vector<std::string>> wrong{
      {},
      {"sink"},
      {"wind"},
      {"wind", "--off", "--speed", "3"},
      {"wind", "--speed", "fast"},
      {"wind", "--speed", "3", "--beaufort", "4"},
      {"wind", "--velocity", "1", "2"},
      {"wind", "--period", "3"},
      {"step", "-1"},
      {"events", "--count", "0"},
      {"status", "--timeout", "0"},
      {"--server", "nowhere:99999", "status"},
      {"--server", "127.0.0.1:0", "status"},
  };
  for (const auto& arguments : wrong) {
    const Outcome outcome = test::run_ctl_with(arguments);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(arguments);
    EXPECT_FALSE(outcome.err.empty()) << testing::PrintToString(arguments);
  }
}

TEST(CtlAlone, HelpHasExamplesAndVersionTells) {
  const Outcome help = test::run_ctl_with({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, HasSubstr("pelagos-ctl wind --speed 12 --from 270"));
  EXPECT_EQ(test::run_ctl_with({"wind", "--help"}).code, 0);
}

TEST(CtlAlone, HelpOfACommandHasItsOwnExamples) {
  const std::string wind = test::run_ctl_with({"wind", "--help"}).out,
                    step = test::run_ctl_with({"step", "--help"}).out;
  EXPECT_THAT(wind, HasSubstr("pelagos-ctl wind --beaufort 7"));
  EXPECT_THAT(wind, Not(HasSubstr("pelagos-ctl wind-at")));
  EXPECT_THAT(wind, Not(HasSubstr("pelagos-ctl boom")));
  EXPECT_THAT(step, HasSubstr("pelagos-ctl pause; pelagos-ctl step 10"));
  EXPECT_THAT(test::run_ctl_with({"command", "--help"}).out, Not(HasSubstr("Examples")));
  const Outcome version = test::run_ctl_with({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, HasSubstr("pelagos-ctl "));
}

/// The program itself, as a shell calls it.
TEST_F(Ctl, TheBinarySpeaksToARunningServer) {
  const std::string command = "'" + test::build_path("bin/pelagos-ctl") +
                              "' --server 127.0.0.1:" + std::to_string(port()) + " status --json 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string out;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) out += buffer;
  EXPECT_EQ(::pclose(pipe), 0) << out;
  EXPECT_EQ(nlohmann::json::parse(out)["scene"], "test");
}

}  // namespace
}  // namespace pelagos
