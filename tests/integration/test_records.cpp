// What programs leave behind: tried before the run, whole or not at all, never lost without a word; and how they end.

#include <arpa/inet.h>
#include <gmock/gmock.h>
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
using testing::Not;

constexpr seconds kPatience{60};

std::vector<std::string> server(const std::vector<std::string>& more, const std::string& file = scene("still_water")) {
  std::vector<std::string> words = {
      program("pelagos-server"), "--scene", file, "--domain", own_domain(), "--control", "127.0.0.1:0"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Waits until the program's errors (its log) hold a text.
bool await_text(RunningProgram& run, const std::string& text) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (run.errors().find(text) == std::string::npos) {
    if (run.wait(milliseconds(0)) || std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return true;
}

/// An address on loopback with a port that was free.
std::string free_endpoint() {
  const int taken = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool good = bind(taken, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                    getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(taken);
  if (!good) throw std::runtime_error("no free port on loopback");
  return "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
}

TEST(Hangup, EndsAServerWithItsReport) {
  const TemporaryFolder folder;
  const std::string report = (folder.path() / "report.json").string();
  RunningProgram run(server({"--report", report}));
  ASSERT_TRUE(await_text(run, "started")) << run.errors();
  run.signal(SIGHUP);
  EXPECT_EQ(run.wait(kPatience), 0) << run.errors();
  EXPECT_EQ(nlohmann::json::parse(read_text(report)).at("end"), "stopped");
}

TEST(Hangup, EndsAViewerWithItsReport) {
  const TemporaryFolder folder;
  RunningProgram run({program("pelagos-viewer"), "--channel", "centre", "--synthetic", "--headless", "--size", "64x36",
                      "--quality", "low", "--out", folder.path().string()});
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!std::filesystem::exists(folder.path() / "centre_0000.png") && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(milliseconds(10));
  run.signal(SIGHUP);
  EXPECT_EQ(run.wait(kPatience), 0) << run.errors();
  EXPECT_GE(nlohmann::json::parse(read_text(folder.path() / "centre.json")).at("frames_drawn"), 1);
}

TEST(Hangup, EndsABridgeInOrder) {
  RunningProgram run({program("pelagos-example-bridge"), "--domain", own_domain()});
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (run.output().empty() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(milliseconds(10));
  run.signal(SIGHUP);
  EXPECT_EQ(run.wait(kPatience), 0) << run.errors();
  EXPECT_THAT(run.output(), HasSubstr("done: "));
}

TEST(Hangup, EndsABenchWithWhatItHas) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "bench.json").string();
  RunningProgram run({program("pelagos-bench"), "run", "--scene", scene("still_water"), "--steps", "10000000",
                      "--threads", "1", "--json", json});
  std::this_thread::sleep_for(milliseconds(500));  // still settling, or stepping
  run.signal(SIGHUP);
  EXPECT_EQ(run.wait(kPatience), 1) << run.errors();
  EXPECT_THAT(run.errors(), HasSubstr("stopped by a signal"));
  EXPECT_EQ(nlohmann::json::parse(read_text(json)).at("stopped"), true);
}

TEST(Outputs, AreTriedBeforeTheRun) {
  const TemporaryFolder folder;
  const std::string missing = (folder.path() / "missing" / "a.json").string();
  const std::vector<std::vector<std::string>> runs = {
      server({"--report", missing}),
      server({"--report", folder.path().string()}),
      server({"--command-log", missing}),
      {program("pelagos-bench"), "run", "--scene", scene("still_water"), "--json", missing},
      {program("pelagos-bench"), "limits", "--scene", scene("still_water"), "--json", missing},
      {program("pelagos-viewer"), "--channel", "centre", "--headless", "--out", "/proc/a"},
      {program("pelagos-validate"), "--quick", "--out", "/proc/a"},
      {program("pelagos-hard"), "--out", "/proc/a"},
  };
  for (const auto& words : runs) {
    RunningProgram run(words);
    EXPECT_THAT(run.wait(kPatience), testing::AnyOf(1, 2)) << words.front();
    EXPECT_THAT(run.errors(), AllOf(HasSubstr(words.back()), Not(HasSubstr("settling")))) << words.front();
  }
}

TEST(CommandLogs, OfAnEarlierRunStay) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.log").string();
  for (const char* name : {"run.log", "run.log.1", "run.log.2"}) {
    RunningProgram run(server({"--unpaced", "--duration", "0.01", "--command-log", log}));
    ASSERT_EQ(run.wait(kPatience), 0) << run.errors();
    EXPECT_THAT(read_text(folder.path() / name), HasSubstr("end { step:")) << name;
    if (std::string(name) == "run.log") continue;
    EXPECT_THAT(run.errors(), AllOf(HasSubstr("is the record of another run and stays as it is"), HasSubstr(name)));
  }
}

/// A scene with more commands than a small disk takes.
std::string write_busy_scene(const TemporaryFolder& folder) {
  const std::string file = (folder.path() / "busy.scene").string();
  std::ofstream out(file);
  out << read_text(scene("still_water"));
  for (int k = 1; k <= 400; ++k)
    out << "event { at: " << 0.001 * k << " set_wind { wind { speed: 1 from_deg: " << k % 360 << " } } }\n";
  return file;
}

TEST(CommandLogs, TellOfAFullDiskAtOnceAndTheSeaGoesOn) {
  const TemporaryFolder folder;
  const std::string log = (folder.path() / "run.log").string();
  std::string command = "ulimit -f 32; exec";  // KiB: the largest file that the server may write
  for (const std::string& word : server({"--command-log", log, "--log-level", "error"}, write_busy_scene(folder)))
    command += " '" + word + "'";
  const std::string endpoint = free_endpoint();  // with errors only in the log, it would not tell that of port 0
  command.replace(command.find("127.0.0.1:0"), 11, endpoint);
  RunningProgram run({"bash", "-c", command});
  ASSERT_TRUE(await_text(run, "cannot be written: File too large; the sea goes on")) << run.errors();

  const auto status = [&] {
    RunningProgram ctl({program("pelagos-ctl"), "--server", endpoint, "status", "--json"});
    EXPECT_EQ(ctl.wait(kPatience), 0) << ctl.errors();
    return nlohmann::json::parse(ctl.output());
  };
  const auto end = std::chrono::steady_clock::now() + kPatience;
  nlohmann::json before = status();
  while (!before.at("command_log").contains("fault") && std::chrono::steady_clock::now() < end) before = status();
  EXPECT_EQ(before.at("command_log").at("fault"), "File too large");
  EXPECT_EQ(before.at("command_log").at("file"), log);
  nlohmann::json after = status();
  while (after.at("step") == before.at("step") && std::chrono::steady_clock::now() < end) after = status();
  EXPECT_GT(after.at("step"), before.at("step"));
  EXPECT_GT(after.at("command_log").at("waiting"), 0);

  run.signal(SIGTERM);
  EXPECT_EQ(run.wait(kPatience), 1);
  EXPECT_THAT(run.errors(), HasSubstr("could not be written to its end: File too large"));
}

TEST(Assets, AreFoundInTheFoldersThatAreNamed) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "own" / "meshes");
  std::filesystem::copy(test::source_path("assets/meshes/coaster_hull.obj"), folder.path() / "own/meshes/my_hull.obj");
  const auto read = [&](const std::string& mesh, const std::vector<std::string>& more) {
    const std::string file = (folder.path() / "a.scene").string();
    std::ofstream(file) << "particle_spacing: 1 patch { min { x: -30 y: -10 z: -8 } max { x: 30 y: 10 z: 8 } }\n"
                           "water { block { min { x: -30 y: -10 z: -8 } max { x: 30 y: 10 z: -4 } } }\n"
                           "body { id: 1 position { } mesh_file: \""
                        << mesh << "\" }\n";
    std::vector<std::string> words = {program("pelagos-bench"), "run", "--scene", file, "--steps", "1"};
    words.insert(words.end(), more.begin(), more.end());
    RunningProgram run(words);
    const int code = run.wait(kPatience).value_or(-1);
    return std::pair(code, run.errors());
  };
  EXPECT_EQ(read("coaster_hull.obj", {}).first, 0) << read("coaster_hull.obj", {}).second;
  EXPECT_EQ(read("meshes/coaster_hull.obj", {}).first, 0);
  EXPECT_EQ(read("my_hull.obj", {"--assets", (folder.path() / "own").string()}).first, 0);
  const auto [status, errors] = read("my_hull.obj", {});
  EXPECT_EQ(status, 1);
  EXPECT_THAT(errors, AllOf(HasSubstr("\"my_hull.obj\" is not there; looked for "), HasSubstr("assets/meshes")));
}

}  // namespace
}  // namespace pelagos
