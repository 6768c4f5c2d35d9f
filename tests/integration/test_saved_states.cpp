// A run of the real server that ends and goes on from its saved state, against one that does not end.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "running_program.hpp"

namespace pelagos {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

constexpr seconds kPatience{60};

/// A small sea with bodies in contact, oil, a wind that ramps, a current that slows down and waves that blend, all of
/// them at 1.5 s, where the state is saved.
constexpr const char* kScene = R"(name: "saved"
particle_spacing: 0.5
patch { min { x: 0 y: 0 z: 0 } max { x: 16 y: 10 z: 5 } }
water { block { min { x: 0 y: 0 z: 0 } max { x: 16 y: 10 z: 2.5 } } settle_steps: 20 }
body {
  id: 1 name: "barge" shape { box { size { x: 4 y: 2 z: 1 } } } drive: FREE
  mass { density: 500 } position { x: 6 y: 5 z: 2.6 }
}
body {
  id: 2 name: "box" shape { box { size { x: 1 y: 1 z: 1 } } } drive: FREE
  mass { density: 400 } position { x: 6 y: 5 z: 3.7 }
}
oil { type: "medium crude" model: BOTH }
wind { speed: 6 from_deg: 270 amplitude: 2 }
current { speed: 0.2 to_deg: 90 }
far_sea { beaufort: 4 wave_to_deg: 90 }
event { at: 0.5 release_oil { name: "hose" from { x: 12 y: 7 z: 1 } rate: 900 } }
event { at: 1 set_wind { wind { speed: 12 } ramp: 2 } }
event { at: 1.2 set_waves { wave { amplitude: 0.5 length: 30 to_deg: 200 } blend: 2 } }
event { at: 1.4 clear_current { } }
event { at: 1.5 stop_release { name: "hose" } }
event { at: 2.5 clear_wind { } }
frame_rate: 20
)";

class SavedStates : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    std::ofstream(path("saved.scene")) << kScene;
    ASSERT_EQ(run({"--duration", "1.5", "--save-state", path("half.state"), "--threads", "2"}).status, 0) << said_;
    EXPECT_THAT(said_, HasSubstr("state saved to " + path("half.state")));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  struct Outcome {
    std::optional<int> status;
    std::string said;
  };
  static Outcome run(const std::vector<std::string>& more, const std::string& scene = "saved.scene") {
    std::vector<std::string> words = {program("pelagos-server"),
                                      "--scene",
                                      path(scene),
                                      "--domain",
                                      own_domain(),
                                      "--control",
                                      "127.0.0.1:0",
                                      "--unpaced"};
    words.insert(words.end(), more.begin(), more.end());
    RunningProgram server(words);
    const std::optional<int> status = server.wait(kPatience);
    said_ = server.errors();
    return {status, said_};
  }
  static std::string path(const std::string& name) { return (folder_->path() / name).string(); }
  static nlohmann::json report(const std::string& name) { return nlohmann::json::parse(read_text(path(name))); }
  static void expect_refused(const std::string& state, const std::string& why,
                             const std::string& scene = "saved.scene") {
    const Outcome outcome = run({"--duration", "3", "--load-state", path(state)}, scene);
    EXPECT_EQ(outcome.status, 1) << state;
    EXPECT_THAT(outcome.said, HasSubstr(why));
  }

  inline static std::unique_ptr<TemporaryFolder> folder_;
  inline static std::string said_;
};

TEST_F(SavedStates, GoOnWithTheSameBits) {
  ASSERT_EQ(run({"--duration", "3", "--threads", "1", "--report", path("straight.json")}).status, 0) << said_;
  ASSERT_EQ(run({"--duration", "3", "--threads", "2", "--report", path("on.json"), "--load-state", path("half.state"),
                 "--command-log", path("on.log")})
                .status,
            0)
      << said_;
  EXPECT_EQ(report("straight.json").at("state"), report("on.json").at("state"));

  // The log of the second half, with the state that it began from, gives the same once more.
  const Outcome again = run({"--duration", "9", "--load-state", path("half.state"), "--replay", path("on.log")});
  EXPECT_EQ(again.status, 0) << again.said;
  EXPECT_THAT(again.said, HasSubstr(", the same bits"));
  const Outcome other = run({"--duration", "9", "--replay", path("on.log")});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.said, HasSubstr("water at the start"));
}

TEST_F(SavedStates, AreRefusedWhereTheyDoNotFit) {
  const std::string bytes = read_text(path("half.state"));
  std::ofstream(path("cut.state")) << bytes.substr(0, bytes.size() / 2);
  expect_refused("cut.state", "allowed: the whole file, unchanged");
  std::string changed = bytes;
  changed[bytes.size() / 2] ^= 1;
  std::ofstream(path("changed.state")) << changed;
  expect_refused("changed.state", "its checksum is wrong");
  std::ofstream(path("empty.state"));
  expect_refused("empty.state", "allowed: a file that --save-state has written");
  expect_refused("missing.state", "no such state file");
  std::string scene = kScene;
  scene.replace(scene.find("max { x: 16"), 11, "max { x: 17");
  std::ofstream(path("other.scene")) << scene;
  expect_refused("half.state", "differs in: patch;", "other.scene");
}

TEST_F(SavedStates, AreTriedBeforeTheRun) {
  const Outcome outcome = run({"--duration", "3", "--save-state", "/nowhere/a.state"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.said, HasSubstr("--save-state /nowhere/a.state"));
}

}  // namespace
}  // namespace pelagos
