// A session of real programs, and the same session again out of its log.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "running_program.hpp"

namespace pelagos {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

constexpr seconds kPatience{60};

/// A small sea with an own ship that a bridge steers, a loose box, oil, wind and a governor.
std::string write_scene(const TemporaryFolder& folder) {
  const std::string file = (folder.path() / "session.scene").string();
  std::ofstream(file) << R"(name: "session"
particle_spacing: 0.5
patch { min { x: 0 y: 0 z: 0 } max { x: 16 y: 10 z: 5 } }
water { block { min { x: 0 y: 0 z: 0 } max { x: 16 y: 10 z: 2.5 } } settle_steps: 20 }
body {
  id: 1 name: "own ship" shape { box { size { x: 4 y: 2 z: 2 } } } drive: POSE_HORIZONTAL
  mass { density: 500 } position { x: 6 y: 5 z: 2.4 }
}
body {
  id: 2 name: "box" shape { box { size { x: 1.5 y: 1.5 z: 1.5 } } } drive: FREE
  mass { density: 400 } position { x: 12 y: 5 z: 2.5 }
}
oil { type: "medium crude" model: BOTH }
wind { speed: 6 from_deg: 270 amplitude: 2 }
current { speed: 0.2 to_deg: 90 }
governor { frame_budget: 0.004 }
far_sea { beaufort: 4 wave_to_deg: 90 }
event { at: 1.5 set_wind { wind { speed: 12 } ramp: 1 } }
event { at: 2 set_waves { wave { amplitude: 0.5 length: 30 to_deg: 200 } blend: 3 } }
event { at: 3 set_sea { system { height: 0.5 peak_period: 4 to_deg: 30 } components: 40 blend: 1 } }
frame_rate: 20
)";
  return file;
}

std::vector<std::string> server(const std::string& scene_file, const std::vector<std::string>& more) {
  std::vector<std::string> words = {program("pelagos-server"), "--scene", scene_file, "--domain", own_domain()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The control link's address out of the server's log.
std::string await_address(RunningProgram& run) {
  const std::string before = "control: listening on ";
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < end && !run.wait(milliseconds(10))) {
    const std::string log = run.errors();
    const std::size_t place = log.find(before);
    if (place == std::string::npos || log.find(" started") == std::string::npos) continue;
    return log.substr(place + before.size(), log.find('\n', place) - place - before.size());
  }
  return "";
}

void command(const std::string& address, const std::vector<std::string>& more) {
  std::vector<std::string> words = {program("pelagos-ctl"), "--server", address};
  words.insert(words.end(), more.begin(), more.end());
  RunningProgram ctl(words);
  EXPECT_EQ(ctl.wait(kPatience), 0) << ctl.errors();
}

/// A busy machine may be slower than real time: the session goes on until it has lasted so long, s simulated.
void await_simulated(const std::string& address, double least) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < end) {
    RunningProgram ctl({program("pelagos-ctl"), "--server", address, "status", "--json"});
    ASSERT_EQ(ctl.wait(kPatience), 0) << ctl.errors();
    const std::string name = "\"simulation_time\":", status = ctl.output();
    const std::size_t place = status.find(name);
    ASSERT_NE(place, std::string::npos) << status;
    if (std::stod(status.substr(place + name.size())) >= least) return;
    std::this_thread::sleep_for(milliseconds(100));
  }
}

/// An instructor, a bridge with probes on its ship, and a pause in between; some seven seconds.
void play_session(const std::string& address) {
  const auto bridge = [](const std::string& sender, const std::string& duration) {
    return std::vector<std::string>{program("pelagos-example-bridge"),
                                    "--domain",
                                    own_domain(),
                                    "--body",
                                    "1",
                                    "--sender",
                                    sender,
                                    "--duration",
                                    duration,
                                    "--east",
                                    "7",
                                    "--north",
                                    "5",
                                    "--radius",
                                    "1.5",
                                    "--speed",
                                    "0.8",
                                    "--water-level",
                                    "2.5",
                                    "--probe-forward",
                                    "2",
                                    "--probe-forward",
                                    "-2"};
  };
  RunningProgram first(bridge("7", "3"));
  command(address, {"wind", "--from", "200", "--ramp", "2"});
  command(address, {"release", "hose", "--from", "12", "7", "1", "--rate", "900", "--duration", "3"});
  command(address, {"probe", "40", "3", "3"});
  command(address, {"waves", "--wave", "0.3,20,90", "0.1,2.5s,60,45", "--blend", "2"});
  command(address, {"boom", "north", "9", "8", "13", "8", "--draft", "0.4"});
  command(address, {"pause"});
  command(address, {"spill", "4", "3", "--volume", "0.02", "--radius", "0.5"});
  command(address, {"step", "3"});
  command(address, {"current", "--speed", "0.5", "--to", "180", "--ramp", "1"});
  std::this_thread::sleep_for(milliseconds(300));
  command(address, {"resume"});
  EXPECT_EQ(first.wait(kPatience), 0) << first.errors();
  command(address, {"probe", "40", "--remove"});
  command(address, {"boom", "north", "--remove"});
  command(address, {"current", "--off"});
  RunningProgram second(bridge("8", "2"));
  EXPECT_EQ(second.wait(kPatience), 0) << second.errors();
  command(address, {"wind", "--off"});
  await_simulated(address, 3.0);
  std::this_thread::sleep_for(milliseconds(500));
}

class ReplayOfASession : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const std::string scene_file = write_scene(*folder_);
    RunningProgram run(server(scene_file, {"--control", "127.0.0.1:0", "--command-log", path("run.log"), "--report",
                                           path("run.json"), "--threads", "2"}));
    const std::string address = await_address(run);
    ASSERT_NE(address, "") << run.errors();
    play_session(address);
    run.signal(SIGINT);
    ASSERT_EQ(run.wait(kPatience), 0) << run.errors();
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string path(const std::string& name) { return (folder_->path() / name).string(); }
  static nlohmann::json report(const std::string& name) { return nlohmann::json::parse(read_text(path(name))); }
  /// @return what the server said
  static std::string replay(const std::string& log, const std::string& report_name, const std::string& threads = "1",
                            int status = 0) {
    RunningProgram run(
        server(path("session.scene"), {"--control", "127.0.0.1:0", "--unpaced", "--replay", log, "--report",
                                       path(report_name), "--threads", threads, "--duration", "60"}));
    EXPECT_EQ(run.wait(kPatience), status) << run.errors();
    return run.errors();
  }

  inline static std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(ReplayOfASession, TheLogHoldsWhoGaveWhat) {
  const std::string log = read_text(path("run.log"));
  for (const char* text :
       {"source: \"bridge 7\"", "source: \"bridge 8\"", "source: \"station 127.0.0.1:", "source: \"scene event 1\"",
        "pose {", "set_probe", "remove_probe", "set_waves { wave { amplitude: 0.3 length: 20 to_deg: 90 }",
        "set_sea { system { spectrum: JONSWAP height: 0.5 peak_period: 4", "world_hash"})
    EXPECT_THAT(log, HasSubstr(text));
}

TEST_F(ReplayOfASession, GivesTheSameStateEverySecond) {
  const std::string said = replay(path("run.log"), "again.json");
  EXPECT_THAT(said, HasSubstr(", the same bits"));
  EXPECT_THAT(said, Not(HasSubstr("not the same bits")));
  const nlohmann::json live = report("run.json"), again = report("again.json");
  EXPECT_EQ(again.at("end"), "replay_ended");
  EXPECT_GE(live.at("speed").at("simulated_s").get<double>(), 3.0) << "a session";
  EXPECT_EQ(live.at("state"), again.at("state"));
}

TEST_F(ReplayOfASession, OfALogThatWasCutOffGoesUpToThere) {
  const std::string log = read_text(path("run.log"));
  const std::size_t middle = log.find("pose {", log.size() / 2) + 40;
  std::ofstream(path("cut.log")) << log.substr(0, middle);
  const std::string said = replay(path("cut.log"), "cut.json");
  EXPECT_THAT(said, HasSubstr("its last, is cut off after 40 bytes and left out"));
  EXPECT_THAT(said, HasSubstr("the log has no end"));
  EXPECT_THAT(said, HasSubstr("replay: the log ends here"));
  EXPECT_THAT(said, Not(HasSubstr("that of the logged run")));
}

TEST_F(ReplayOfASession, ComparesTheStart) {
  std::string log = read_text(path("run.log"));
  const std::size_t hash = log.find("world_hash: \"") + 13;
  log[hash] = log[hash] == '0' ? '1' : '0';
  std::ofstream(path("start.log")) << log;
  EXPECT_THAT(replay(path("start.log"), "start.json", "1", 4),
              HasSubstr("the first that differs is that after step 0"));
}

/// The log would not help if it said the same of any run.
TEST_F(ReplayOfASession, TellsWhereAnotherRunDiffers) {
  std::string log = read_text(path("run.log"));
  const std::size_t rate = log.find("rate: 900");
  ASSERT_NE(rate, std::string::npos);
  log.replace(rate, 9, "rate: 901");
  std::ofstream(path("other.log")) << log;
  const std::string said = replay(path("other.log"), "other.json", "1", 4);
  EXPECT_THAT(said, HasSubstr("the first that differs is that after"));
  EXPECT_EQ(report("other.json").at("replay"), "other bits");
}

}  // namespace
}  // namespace pelagos
