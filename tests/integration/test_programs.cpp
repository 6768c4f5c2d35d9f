// The programs from outside: command lines, exit codes, signals, files that cannot be written.

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <nlohmann/json.hpp>

#include "../support/places.hpp"
#include "running_program.hpp"

namespace pelagos {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::HasSubstr;

/// For what takes milliseconds, on a machine with other work.
constexpr seconds kPatience{60};
/// For what takes seconds, on such a machine.
constexpr seconds kLongPatience{240};

/// A TCP socket on loopback that listens on a free port.
class TakenPort {
 public:
  TakenPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(socket_, 1) != 0 ||
        getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("no free port on loopback");
    endpoint_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  }
  ~TakenPort() { close(socket_); }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  [[nodiscard]] const std::string& endpoint() const { return endpoint_; }

 private:
  int socket_ = socket(AF_INET, SOCK_STREAM, 0);
  std::string endpoint_;
};

std::string free_endpoint() { return TakenPort().endpoint(); }

std::vector<std::string> server_arguments(const std::string& scene_file, const std::string& endpoint) {
  return {program("pelagos-server"), "--scene", scene_file, "--domain", own_domain(), "--control", endpoint};
}

/// A server on a small patch that answers.
class Server : public testing::Test {
 protected:
  void start(const std::vector<std::string>& more = {}, const std::string& scene_file = scene("still_water")) {
    std::vector<std::string> arguments = server_arguments(scene_file, endpoint_);
    arguments.insert(arguments.end(), more.begin(), more.end());
    server_ = std::make_unique<RunningProgram>(arguments);
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (ask({"status"}) != 0 || answer_.find("starting") != std::string::npos) {
      ASSERT_FALSE(server_->wait(milliseconds(0))) << server_->errors();
      ASSERT_LT(std::chrono::steady_clock::now(), end) << server_->errors();
    }
  }

  int ask(const std::vector<std::string>& command) {
    std::vector<std::string> arguments = {program("pelagos-ctl"), "--server", endpoint_};
    arguments.insert(arguments.end(), command.begin(), command.end());
    RunningProgram ctl(arguments);
    const int code = ctl.wait(kPatience).value_or(-1);
    answer_ = ctl.output();
    return code;
  }

  std::string endpoint_ = free_endpoint();
  std::unique_ptr<RunningProgram> server_;
  std::string answer_;
};

TEST_F(Server, EndsWithinASecondOfSigterm) {
  start();
  const auto begin = std::chrono::steady_clock::now();
  server_->signal(SIGTERM);
  EXPECT_EQ(server_->wait(kPatience), 0) << server_->errors();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(1));
}

TEST_F(Server, AnswersCommandsAtOnceWhileItSettlesItsWater) {
  const TemporaryFolder folder;
  const std::string scene_file = (folder.path() / "slow_start.scene").string();
  std::ofstream(scene_file) << "particle_spacing: 0.1 patch { min { } max { x: 3 y: 3 z: 2 } }\n"
                               "water { block { min { } max { x: 3 y: 3 z: 1 } } settle_steps: 500 }\n"
                               "wind { speed: 9 from_deg: 270 }\n";
  server_ = std::make_unique<RunningProgram>(server_arguments(scene_file, endpoint_));
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (ask({"pause"}) != 0) ASSERT_LT(std::chrono::steady_clock::now(), end) << server_->errors();
  EXPECT_EQ(
      answer_,
      "scheduled as 1: the server still places and settles its water; the first step decides, and an event and the "
      "status tell if it refuses\n");
  ASSERT_EQ(ask({"status", "--json"}), 0);
  const nlohmann::json first = nlohmann::json::parse(answer_);
  EXPECT_EQ(first.at("starting"), true);
  EXPECT_EQ(first.at("wind").at("speed"), 9.0);
  EXPECT_GT(first.at("density_tolerance"), 0.0);
  EXPECT_EQ(first.at("scheduled"), 1);
  EXPECT_GE(first.at("settled"), 0.0);
  EXPECT_EQ(ask({"probe", "1", "--remove"}), 1) << "there is none, nor will there be one";
  ASSERT_EQ(ask({"wind-at", "1", "1", "11", "--json"}), 0);
  EXPECT_GT(nlohmann::json::parse(answer_).at("place").at(0).at("speed"), 8.0);
  EXPECT_EQ(ask({"probe", "1", "9", "9"}), 1) << "it lies outside the patch";
  ASSERT_EQ(ask({"schedule"}), 0);
  EXPECT_THAT(answer_, HasSubstr("pause"));
  nlohmann::json status;
  do {
    ASSERT_EQ(ask({"status", "--json"}), 0);
    status = nlohmann::json::parse(answer_);
  } while (status.at("paused") == false && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(status.at("starting"), false);
  EXPECT_EQ(status.at("paused"), true);
  EXPECT_EQ(status.at("step"), 0);
}

TEST_F(Server, EndsOnSigintToo) {
  start();
  server_->signal(SIGINT);
  EXPECT_EQ(server_->wait(kPatience), 0) << server_->errors();
}

TEST_F(Server, ReportsAFullDisk) {
  start({"--report", "/dev/full"});
  server_->signal(SIGTERM);
  EXPECT_EQ(server_->wait(kPatience), 1);
  EXPECT_THAT(server_->errors(), HasSubstr("/dev/full"));
}

TEST_F(Server, GoesOnWhenABridgeSendsForAnUnknownBody) {
  start();
  RunningProgram bridge(
      {program("pelagos-example-bridge"), "--domain", own_domain(), "--body", "77", "--duration", "1"});
  EXPECT_EQ(bridge.wait(kPatience), 0) << bridge.errors();
  nlohmann::json status;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {  // the status is renewed once a second
    ASSERT_EQ(ask({"status", "--json"}), 0);
    status = nlohmann::json::parse(answer_);
  } while (status.at("poses_refused") == 0 && std::chrono::steady_clock::now() < end);
  EXPECT_GT(status.at("poses_refused"), 0);
  EXPECT_EQ(status.at("poses_accepted"), 0);
}

TEST_F(Server, TellsTheWindAtAMast) {
  start();
  ASSERT_EQ(ask({"wind-at", "--json", "0", "0", "10"}), 0);
  EXPECT_EQ(nlohmann::json::parse(answer_).at("place").at(0).at("speed"), 0.0) << "a calm";
  ASSERT_EQ(ask({"wind", "--speed", "12", "--from", "270", "--roughness", "0.001"}), 0);
  // The water of this scene stands at 0.5 m: masts of 10 m and of 1 m, and a place under water.
  const std::vector<std::string> query = {"wind-at", "--json", "0", "0", "10.5", "0", "0", "1.5", "-7", "0.5", "0.2"};
  nlohmann::json places;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {  // until the command has taken effect at a step boundary
    ASSERT_EQ(ask(query), 0);
    places = nlohmann::json::parse(answer_).at("place");
  } while (places.at(0).at("speed") == 0.0 && std::chrono::steady_clock::now() < end);
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NEAR(places[0].at("speed").get<double>(), 12.0, 1e-9);
  EXPECT_NEAR(places[0].at("from_deg").get<double>(), 270.0, 1e-9);
  EXPECT_NEAR(places[1].at("speed").get<double>(), 9.0, 1e-6);  // ln(1000) / ln(10000) = 3/4
  EXPECT_EQ(places[2].at("speed").get<double>(), 0.0);
}

TEST_F(Server, SaysWhenAPulseNeverCloses) {
  const TemporaryFolder folder;
  const std::string scene_file = (folder.path() / "endless.scene").string();
  std::ofstream(scene_file) << read_text(scene("still_water"))
                            << "wind { velocity { x: 2 } law: PAPER pulse { period: 10 width: 100 } }\n";
  start({}, scene_file);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (server_->errors().find("never closes") == std::string::npos && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(milliseconds(20));
  EXPECT_THAT(server_->errors(), HasSubstr("its pulse blows 100 steps of every 10: it never closes"));
}

TEST_F(Server, PaysWithAccuracyWithinBoundsAndSaysSo) {
  // No machine makes a frame of this patch in 0.1 ms: the governor must end at its bounds.
  const TemporaryFolder folder;
  const std::string scene_file = (folder.path() / "heavy.scene").string(),
                    report = (folder.path() / "run.json").string();
  std::ofstream(scene_file) << read_text(scene("still_water"))
                            << "governor { frame_budget: 1e-4 largest_tolerance: 2e-3 largest_step: 0.008 }\n";
  start({"--report", report}, scene_file);
  nlohmann::json status;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {
    ASSERT_EQ(ask({"status", "--json"}), 0);
    status = nlohmann::json::parse(answer_);
  } while (status.at("over_budget") == false && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(status.at("governed"), true);
  EXPECT_EQ(status.at("over_budget"), true);
  EXPECT_EQ(status.at("max_step"), 0.008);
  EXPECT_EQ(status.at("density_tolerance"), 2e-3);
  EXPECT_EQ(status.at("divergence_tolerance"), 2e-3);
  ASSERT_EQ(ask({"status"}), 0);
  EXPECT_THAT(answer_, HasSubstr("governor at its bounds"));
  server_->signal(SIGTERM);
  EXPECT_EQ(server_->wait(kPatience), 0) << server_->errors();
  EXPECT_THAT(server_->errors(), AllOf(HasSubstr("by governor: coarser, a frame took"),
                                       HasSubstr("steps up to 8 ms, tolerances 0.002 and 0.002"),
                                       HasSubstr("at the scene's bounds and over the budget")));
  const nlohmann::json effort = nlohmann::json::parse(read_text(report)).at("effort");
  EXPECT_EQ(effort.at("governed"), true);
  EXPECT_GE(effort.at("changes"), 1);
  EXPECT_EQ(effort.at("max_step_s"), 0.008);
}

TEST_F(Server, TellsOfAToleranceThatIsOutOfReach) {
  const TemporaryFolder folder;
  const std::string scene_file = (folder.path() / "strict.scene").string();
  std::ofstream(scene_file) << read_text(scene("still_water"))
                            << "solver { divergence { tolerance: 1e-6 max_iterations: 3 } }\n";
  start({}, scene_file);
  nlohmann::json status;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {  // the status is renewed once a second
    ASSERT_EQ(ask({"status", "--json"}), 0);
    status = nlohmann::json::parse(answer_);
  } while (status.at("unconverged_steps") == 0 && std::chrono::steady_clock::now() < end);
  EXPECT_GT(status.at("unconverged_steps"), 0);
  const std::string warning = "the divergence constraint missed its tolerance in";
  while (server_->errors().find(warning) == std::string::npos && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(milliseconds(50));  // told with the line of every 5 s
  EXPECT_THAT(server_->errors(), AllOf(HasSubstr(warning), HasSubstr("against 1e-06 after 3 iterations"),
                                       HasSubstr("raise solver.divergence.max_iterations")));
}

TEST_F(Server, IsExactWithoutAGovernor) {
  start();
  nlohmann::json status;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {  // the effort is part of the first status that a step makes
    ASSERT_EQ(ask({"status", "--json"}), 0);
    status = nlohmann::json::parse(answer_);
  } while (status.at("step") == 0 && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(status.at("governed"), false);
  EXPECT_EQ(status.at("over_budget"), false);
  EXPECT_EQ(status.at("density_tolerance"), 3e-4);
  EXPECT_EQ(status.at("divergence_tolerance"), 3e-4);
  EXPECT_EQ(status.at("recoveries"), 0);
}

/// A run of the storm to its end, unpaced, with more options; the state of the water after it, from its report.
nlohmann::json run_storm(const TemporaryFolder& folder, const std::vector<std::string>& more, std::string& errors,
                         const std::string& scene_file = scene("storm_rises")) {
  const std::string report = (folder.path() / "storm.json").string();
  std::vector<std::string> arguments = server_arguments(scene_file, "127.0.0.1:0");
  for (const char* option : {"--unpaced", "--report"}) arguments.emplace_back(option);
  arguments.push_back(report);
  arguments.insert(arguments.end(), more.begin(), more.end());
  RunningProgram server(arguments);
  EXPECT_EQ(server.wait(kLongPatience), 0) << server.errors();
  errors = server.errors();
  return nlohmann::json::parse(read_text(report));
}

TEST(ServerEvents, HappenAtTheirTimesAndReplayToTheSameBits) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "storm.log").string();
  std::string first_errors, second_errors;
  const auto first = run_storm(folder, {"--duration", "8.5", "--threads", "2", "--command-log", log}, first_errors);
  EXPECT_EQ(first.at("end"), "duration_reached");
  EXPECT_NEAR(first.at("wind").at("speed_m_s").get<double>(), 18.9, 0.1);  // force 8
  EXPECT_THAT(first_errors, AllOf(HasSubstr("by scene event 1: wind 18.9 m/s from 270 deg"),
                                  HasSubstr("by scene event 2"), testing::Not(HasSubstr("by scene event 3")),
                                  HasSubstr("commands that were not due before the end: 2")));
  EXPECT_THAT(read_text(log), AllOf(HasSubstr("source: \"scene event 1\" set_wind"), HasSubstr("end { step:")));

  const auto second = run_storm(folder, {"--threads", "1", "--replay", log}, second_errors);
  EXPECT_EQ(second.at("end"), "replay_ended");
  EXPECT_EQ(second.at("state"), first.at("state"));
  EXPECT_THAT(second_errors, AllOf(HasSubstr("by replay of scene event 1"), HasSubstr("the same bits")));
}

TEST(ServerEvents, NoReplayOfAnotherScene) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "a.log").string();
  std::ofstream(log) << "scene: \"storm_rises\" seed: 7 particles: 3249\n";
  std::vector<std::string> arguments = server_arguments(scene("still_water"), "127.0.0.1:0");
  arguments.insert(arguments.end(), {"--replay", log});
  RunningProgram server(arguments);
  EXPECT_EQ(server.wait(kPatience), 1);
  EXPECT_THAT(server.errors(), HasSubstr("is of scene storm_rises with seed 7"));
  RunningProgram missing({program("pelagos-server"), "--scene", scene("still_water"), "--replay", "/nowhere/a.log"});
  EXPECT_EQ(missing.wait(kPatience), 1);
  EXPECT_THAT(missing.errors(), HasSubstr("/nowhere/a.log: no such command log file"));
}

TEST(ServerEvents, ALogThatCannotBeWrittenIsSaid) {
  std::vector<std::string> arguments = server_arguments(scene("still_water"), "127.0.0.1:0");
  arguments.insert(arguments.end(), {"--command-log", "/nowhere/a.log"});
  RunningProgram server(arguments);
  EXPECT_EQ(server.wait(kPatience), 1);
  EXPECT_THAT(server.errors(), HasSubstr("--command-log /nowhere/a.log: there is no folder /nowhere"));
}

TEST_F(Server, SchedulesCommandsOfStationsAndLogsThem) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.log").string();
  start({"--command-log", log});
  ASSERT_EQ(ask({"pause"}), 0);
  ASSERT_EQ(ask({"current", "--speed", "1", "--to", "90", "--at", "1000000"}), 0);
  EXPECT_EQ(answer_, "scheduled as 1\n");
  ASSERT_EQ(ask({"wind", "--speed", "5", "--from", "0", "--at", "2000000"}), 0);
  ASSERT_EQ(ask({"schedule"}), 0);
  EXPECT_THAT(answer_, AllOf(HasSubstr("set_current"), HasSubstr("set_wind")));
  ASSERT_EQ(ask({"cancel", "1"}), 0);
  ASSERT_EQ(ask({"current", "--speed", "1", "--to", "90"}), 0);
  ASSERT_EQ(ask({"resume"}), 0);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (ask({"pause", "--at", "0"}) == 0 && std::chrono::steady_clock::now() < end) {  // until the present is later
    ASSERT_EQ(ask({"resume"}), 0);
  }
  while (server_->errors().find("carries only what drifts") == std::string::npos &&
         std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(milliseconds(20));
  server_->signal(SIGTERM);
  EXPECT_EQ(server_->wait(kPatience), 0) << server_->errors();
  EXPECT_THAT(server_->errors(), AllOf(HasSubstr("scheduled command 1 for 1e+06 s: current 1.00 m/s to 90 deg"),
                                       HasSubstr("cancelled command 1"), HasSubstr("closed along x"),
                                       HasSubstr("commands that were not due before the end: 1")));
  EXPECT_THAT(read_text(log), AllOf(HasSubstr("pause {"), HasSubstr("set_current {"), HasSubstr("resume {"),
                                    testing::Not(HasSubstr("set_wind"))));
}

TEST_F(Server, RefusesOilThatDoesNotFitAndTellsOfSourcesAndSkimmers) {
  const TemporaryFolder folder;
  const std::string scene_file = (folder.path() / "oily.scene").string();
  std::ofstream(scene_file) << read_text(scene("still_water")) << "oil { type: \"diesel\" model: SLICK }\n";
  start({"--unpaced"}, scene_file);
  EXPECT_EQ(ask({"spill", "99", "0", "--volume", "1", "--json"}), 1);
  EXPECT_THAT(answer_, HasSubstr("command.spill_oil.position: (99, 0) m is outside the patch"));
  EXPECT_EQ(ask({"boom", "north", "--remove", "--json"}), 1);
  EXPECT_THAT(answer_, HasSubstr("command.remove_boom.name: there is no boom"));
  ASSERT_EQ(ask({"skimmer", "rig", "0.1", "0.1", "--radius", "0.05"}), 0);
  const auto end = std::chrono::steady_clock::now() + kLongPatience;
  const auto wait_for = [&](const std::string& words) {
    while (server_->errors().find(words) == std::string::npos && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(milliseconds(20));
  };
  wait_for("has been dry for 5 s");
  ASSERT_EQ(ask({"release", "leak", "--from", "0.5", "0.5", "0.2", "--rate", "0.36", "--duration", "1"}), 0);
  wait_for("has ended");
  ASSERT_EQ(ask({"status", "--json"}), 0);
  const auto oil = nlohmann::json::parse(answer_).at("oil");
  EXPECT_NEAR(oil.at("released").get<double>(), 1e-4 * 852.98, 1e-5);
  EXPECT_EQ(ask({"release", "leak", "--stop", "--json"}), 1);
  EXPECT_THAT(answer_, HasSubstr("there is no source")) << "it has run out";
  server_->signal(SIGTERM);
  EXPECT_EQ(server_->wait(kPatience), 0) << server_->errors();
  EXPECT_THAT(server_->errors(), AllOf(HasSubstr("by server: skimmer \"rig\" has been dry for 5 s"),
                                       HasSubstr("by server: source \"leak\" has ended")));
}

TEST(ServerCommandLine, RefusesAnUnknownOption) {
  RunningProgram server({program("pelagos-server"), "--scene", scene("still_water"), "--wings"});
  EXPECT_EQ(server.wait(kPatience), 2);
  EXPECT_THAT(server.errors(), HasSubstr("--wings"));
}

TEST(ServerCommandLine, NeedsAScene) {
  RunningProgram server({program("pelagos-server")});
  EXPECT_EQ(server.wait(kPatience), 2);
  EXPECT_THAT(server.errors(), HasSubstr("--scene"));
}

TEST(ServerCommandLine, NamesASceneThatIsNotThere) {
  RunningProgram server(server_arguments("/nowhere/a.scene", free_endpoint()));
  EXPECT_GT(server.wait(kPatience), 0);
  EXPECT_THAT(server.errors(), HasSubstr("/nowhere/a.scene"));
}

TEST(ServerCommandLine, RefusesASceneOfABillionParticles) {
  const TemporaryFolder folder;
  std::string text = read_text(scene("still_water"));
  const std::string spacing = "particle_spacing: 0.05";
  const std::size_t at = text.find(spacing);
  ASSERT_NE(at, std::string::npos);
  const std::filesystem::path huge = folder.path() / "huge.scene";
  std::ofstream(huge) << text.replace(at, spacing.size(), "particle_spacing: 0.0008");
  RunningProgram server(server_arguments(huge.string(), free_endpoint()));
  EXPECT_GT(server.wait(kPatience), 0);
  EXPECT_THAT(server.errors(), AllOf(HasSubstr("huge.scene"), HasSubstr("particle")));
}

TEST(ServerCommandLine, RefusesNoThreads) {
  for (const char* threads : {"0", "-1", "many"}) {
    RunningProgram server({program("pelagos-server"), "--scene", scene("still_water"), "--threads", threads});
    EXPECT_EQ(server.wait(kPatience), 2) << threads;
    EXPECT_THAT(server.errors(), HasSubstr("--threads"));
  }
}

TEST(ServerCommandLine, RefusesAControlAddressThatIsNone) {
  for (const char* endpoint : {"nonsense", "127.0.0.1:99999", "127.0.0.1:"}) {
    RunningProgram server(server_arguments(scene("still_water"), endpoint));
    EXPECT_GT(server.wait(kPatience), 0) << endpoint;
    EXPECT_THAT(server.errors(), HasSubstr("control")) << endpoint;
  }
}

TEST(ServerCommandLine, SaysThatThePortIsTaken) {
  const TakenPort taken;
  RunningProgram server(server_arguments(scene("still_water"), taken.endpoint()));
  EXPECT_EQ(server.wait(kPatience), 1);
  const std::string port = taken.endpoint().substr(taken.endpoint().find(':') + 1);
  EXPECT_THAT(server.errors(), HasSubstr(port));
}

TEST(Ctl, SaysThatNoServerAnswers) {
  const std::string endpoint = free_endpoint();
  RunningProgram ctl({program("pelagos-ctl"), "--server", endpoint, "status"});
  EXPECT_EQ(ctl.wait(kPatience), 1);
  EXPECT_THAT(ctl.errors(), HasSubstr(endpoint));
}

std::vector<std::string> viewer_arguments(const std::filesystem::path& out) {
  return {program("pelagos-viewer"),
          "--channel",
          "centre",
          "--synthetic",
          "--headless",
          "--frames",
          "1",
          "--size",
          "160x90",
          "--out",
          out.string()};
}

TEST(Viewer, RefusesAFolderThatCannotBeMade) {
  RunningProgram viewer(viewer_arguments("/proc/pelagos"));
  EXPECT_EQ(viewer.wait(kPatience), 1);
  EXPECT_THAT(viewer.errors(), HasSubstr("/proc/pelagos"));
}

TEST(Viewer, ReportsAFullDisk) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "centre_0000.png.part");  // where a picture is written
  RunningProgram viewer(viewer_arguments(folder.path()));
  EXPECT_EQ(viewer.wait(kPatience), 1);
  EXPECT_THAT(viewer.errors(), HasSubstr("centre_0000.png"));
}

TEST(Viewer, NamesTheChannelsOfTheRig) {
  RunningProgram viewer({program("pelagos-viewer"), "--channel", "crow's nest", "--headless"});
  EXPECT_EQ(viewer.wait(kPatience), 2);
  EXPECT_THAT(viewer.errors(), AllOf(HasSubstr("crow's nest"), HasSubstr("starboard")));
}

TEST(Viewer, EndsWhereNoServerIs) {
  const TemporaryFolder folder;
  RunningProgram viewer({program("pelagos-viewer"), "--channel", "centre", "--headless", "--domain", own_domain(),
                         "--wait", "0.5", "--out", folder.path().string()});
  EXPECT_EQ(viewer.wait(kPatience), 1);
  EXPECT_THAT(viewer.errors(), HasSubstr("no server"));
}

struct WrongNumber {
  std::vector<std::string> command;  ///< without the option
  std::string option, value, allowed;
};

class CommandLine : public testing::TestWithParam<WrongNumber> {};

TEST_P(CommandLine, RefusesANumberThatIsNoneOrOutOfRange) {
  const WrongNumber& wrong = GetParam();
  std::vector<std::string> arguments = wrong.command;
  arguments.front() = program(arguments.front());
  arguments.insert(arguments.end(), {wrong.option, wrong.value});
  RunningProgram run(arguments);
  EXPECT_EQ(run.wait(kPatience), 2);
  EXPECT_THAT(run.errors(), HasSubstr(wrong.option + ": is " + wrong.value + "; allowed: " + wrong.allowed));
}

const std::vector<std::string> kBench = {"pelagos-bench", "run", "--scene", scene("still_water")};
const std::vector<std::string> kViewer = {"pelagos-viewer", "--channel", "centre", "--headless"};

INSTANTIATE_TEST_SUITE_P(Numbers, CommandLine,
                         testing::Values(WrongNumber{kBench, "--tolerance", "nan", "1e-06 to 0.05"},
                                         WrongNumber{kBench, "--tolerance", "-0.1", "1e-06 to 0.05"},
                                         WrongNumber{kBench, "--tolerance", "a lot", "1e-06 to 0.05"},
                                         WrongNumber{kBench, "--seconds", "nan", "0.001 to 1e+06"},
                                         WrongNumber{kBench, "--seconds", "inf", "0.001 to 1e+06"},
                                         WrongNumber{kBench, "--spacing", "nan", "0.001 to 100"},
                                         WrongNumber{
                                             {"pelagos-server", "--scene", "a"}, "--duration", "nan", "0 to 1e+09"},
                                         WrongNumber{{"pelagos-ctl", "status"}, "--timeout", "nan", "0.05 to 3600"},
                                         WrongNumber{{"pelagos-ctl", "events"}, "--duration", "nan", "0.01 to 1e+09"},
                                         WrongNumber{{"pelagos-example-bridge"}, "--rate", "nan", "0.1 to 1000"},
                                         WrongNumber{kViewer, "--wait", "nan", "0 to 100000"}));

TEST(Bench, ToleranceIsThatOfBothConstraints) {
  for (const char* solver : {"hybrid", "dfsph", "pbf", "corrected"}) {
    RunningProgram bench({program("pelagos-bench"), "run", "--scene", scene("still_water"), "--solver", solver,
                          "--tolerance", "1e-4", "--steps", "1"});
    ASSERT_EQ(bench.wait(kPatience), 0) << bench.errors();
    const nlohmann::json result = nlohmann::json::parse(bench.output());
    EXPECT_EQ(result.at("tolerance"), 1e-4) << solver;
    EXPECT_EQ(result.at("divergence_tolerance"), 1e-4) << solver;
  }
}

TEST(Hard, RefusesALongRunThatIsTooShortToJudge) {
  RunningProgram hard({program("pelagos-hard"), "long", "--steps", "100"});
  EXPECT_EQ(hard.wait(kPatience), 2);
  EXPECT_THAT(hard.errors(), AllOf(HasSubstr("--steps"), HasSubstr("100"), HasSubstr("3000")));
}

class EveryProgram : public testing::TestWithParam<const char*> {};

TEST_P(EveryProgram, ExplainsItself) {
  RunningProgram help({program(GetParam()), "--help"});
  EXPECT_EQ(help.wait(kPatience), 0);
  EXPECT_THAT(help.output(), AllOf(HasSubstr("--help"), HasSubstr("--version")));
  EXPECT_EQ(help.errors(), "");
}

TEST_P(EveryProgram, TellsItsVersion) {
  RunningProgram version({program(GetParam()), "--version"});
  EXPECT_EQ(version.wait(kPatience), 0);
  EXPECT_EQ(version.output(), std::string(GetParam()) + " " PELAGOS_VERSION "\n");
}

TEST_P(EveryProgram, RefusesAnUnknownOption) {
  RunningProgram wrong({program(GetParam()), "--no-such-option"});
  EXPECT_EQ(wrong.wait(kPatience), 2);
  EXPECT_THAT(wrong.errors(),
              AllOf(testing::StartsWith(std::string(GetParam()) + ": "), HasSubstr("unknown option --no-such-option")));
}

INSTANTIATE_TEST_SUITE_P(Programs, EveryProgram,
                         testing::Values("pelagos-server", "pelagos-viewer", "pelagos-ctl", "pelagos-bench",
                                         "pelagos-example-bridge", "pelagos-demo-summary", "pelagos-validate",
                                         "pelagos-hard", "pelagos-mesh"));

}  // namespace
}  // namespace pelagos
