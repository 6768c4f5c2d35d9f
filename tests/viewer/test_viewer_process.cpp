#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "child_process.hpp"
#include "loopback.hpp"
#include "renderer/gl_context.hpp"
#include "renderer/gl_objects.hpp"
#include "source/frame_source.hpp"

namespace pelagos {
namespace {

using nlohmann::json;

/// A server that publishes the synthetic sea at 30 Hz until it is destroyed; with a film of oil beside the ship if so
/// wanted.
class SeaServer {
 public:
  explicit SeaServer(bool oil = false)
      : participant_(join_dds(test_settings())), publisher_(participant_, synthetic_scene()) {
    thread_ = std::thread([this, oil] {
      OceanFrame frame;
      for (std::uint64_t number = 0; !stop_; ++number) {
        fill_synthetic_frame(static_cast<double>(number) / 30.0, frame);
        auto snapshot = publisher_.acquire();
        snapshot->frame = number;
        snapshot->simulation_time = frame.simulation_time;
        snapshot->wall_time_ns =
            std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
                .count();
        snapshot->particles = frame.particles;
        snapshot->bodies = frame.bodies;
        snapshot->total_particles = frame.total_particles;
        snapshot->status.real_time_factor = 1.0;
        if (oil) snapshot->oil.emplace().discs = {{0.0F, -12.0F, 0.0F, 6.0F, 1e-3F, 50.0F, 0.0F, {}, false}};
        publisher_.submit(std::move(snapshot));
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
      }
    });
  }
  ~SeaServer() {
    stop_ = true;
    thread_.join();
  }

  /// Another scene, as if it were this server's.
  void publish(const SceneInfo& scene) const { publisher_.publish_scene_info(scene); }

 private:
  std::shared_ptr<DdsParticipant> participant_;
  mutable FramePublisher publisher_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class ViewerProcess : public testing::Test {
 protected:
  void SetUp() override {
    try {
      const HeadlessContext context;
    } catch (const GraphicsError& error) {
      GTEST_SKIP() << error.what();
    }
    out_ = std::filesystem::path(testing::TempDir()) / ("viewer_" + std::to_string(getpid()));
    std::filesystem::remove_all(out_);
  }
  void TearDown() override { std::filesystem::remove_all(out_); }

  [[nodiscard]] std::vector<std::string> command(std::vector<std::string> more) const {
    std::vector<std::string> words = {PELAGOS_VIEWER, "--headless", "--size",
                                      "160x90",       "--domain",   std::to_string(test_settings().domain),
                                      "--out",        out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] json report(const std::string& channel) const {
    std::ifstream in(out_ / (channel + ".json"));
    return json::parse(in, nullptr, false);
  }
  /// How many have been written.
  [[nodiscard]] int pictures() const {
    int count = 0;
    if (std::filesystem::exists(out_))
      for (const auto& entry : std::filesystem::directory_iterator(out_)) count += entry.path().extension() == ".png";
    return count;
  }

  std::filesystem::path out_;
};

TEST_F(ViewerProcess, DrawsFramesOfAServer) {
  const SeaServer server;
  ChildProcess viewer(command({"--channel", "starboard", "--frames", "5"}));
  EXPECT_EQ(viewer.wait_for_end(), 0);
  const json result = report("starboard");
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result["frames_drawn"], 5);
  EXPECT_EQ(result["pictures_written"], 5);
  EXPECT_EQ(result["scene"], "synthetic");
  EXPECT_GE(result["frames_received"], 1);
  EXPECT_GT(result["latency_ms"]["mean"], 0.0);
  EXPECT_LT(result["latency_ms"]["p50"], 10'000.0) << "same clock on both sides";
  EXPECT_EQ(result["slicks_received"], 0);
  EXPECT_FALSE(result["gl_renderer"].get<std::string>().empty());
  EXPECT_EQ(result["errors"], json::array());
  for (int i = 0; i < 5; ++i)
    EXPECT_GT(std::filesystem::file_size(out_ / ("starboard_000" + std::to_string(i) + ".png")), 1000u);
}

TEST_F(ViewerProcess, DrawsTheSlickOfAServer) {
  const SeaServer server(true);
  ChildProcess viewer(command({"--channel", "starboard", "--frames", "15"}));
  EXPECT_EQ(viewer.wait_for_end(), 0);
  const json result = report("starboard");
  ASSERT_TRUE(result.is_object());
  EXPECT_GE(result["slicks_received"], 1);
  EXPECT_EQ(result["slicks_refused"], 0);
  EXPECT_EQ(result["errors"], json::array());
}

TEST_F(ViewerProcess, ShowsTheLastFrameOfASeaThatIsPaused) {
  const auto participant = join_dds(test_settings());
  FramePublisher publisher(participant, synthetic_scene());
  OceanFrame frame;
  fill_synthetic_frame(1.0, frame);
  auto snapshot = publisher.acquire();
  snapshot->frame = 30;
  snapshot->particles = frame.particles;
  snapshot->bodies = frame.bodies;
  publisher.submit(std::move(snapshot));
  ServerStatus paused;
  paused.paused = true;
  publisher.submit_status(paused);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // nobody listens yet
  ChildProcess viewer(command({"--channel", "port", "--frames", "1", "--wait", "20"}));
  EXPECT_EQ(viewer.wait_for_end(), 0);
  const json result = report("port");
  EXPECT_EQ(result["paused"], true);
  EXPECT_EQ(result["pictures_written"], 1);
  EXPECT_EQ(result["frames_received"], 1);
  EXPECT_TRUE(result["latency_ms"].is_null()) << "the frame is as old as the pause";
}

/// A scene of as many bodies as there may be, each with a mesh of its own that is as large as may be sent.
SceneInfo heavy_scene() {
  SceneInfo scene = synthetic_scene();
  scene.bodies.clear();
  for (std::uint32_t id = 1; id <= 20; ++id) {
    auto surface = std::make_shared<BodySurface>();
    surface->file_digest = id;
    surface->high.setConstant(id);
    for (std::uint32_t v = 0; v < 1000; ++v) surface->vertices.emplace_back(v % 10, v / 10 % 10, v / 100 + id);
    for (std::uint32_t t = 0; t < 50'000; ++t) surface->triangles.push_back({t % 998, t % 998 + 1, t % 998 + 2});
    surface->triangle_count = 50'000;
    scene.bodies.push_back({id, "crowd", "crowd.obj", 1.0, surface});
  }
  return scene;
}

TEST_F(ViewerProcess, HostileScenesNeitherEndNorHangIt) {
  const SeaServer server;
  ChildProcess viewer(command({"--channel", "port", "--every", "0.3"}));
  ASSERT_TRUE(eventually([&] { return pictures() >= 2; }));
  // The server itself has gone mad: all that follows has its source.
  SceneInfo scene = synthetic_scene();
  scene.bodies[0].mesh_file = std::string(256, 'm') + ".obj";
  server.publish(scene);
  scene.bodies[0].mesh_file = "../../../etc/passwd\x1b[31m";
  server.publish(scene);
  scene.bodies.assign(4096, scene.bodies[0]);
  server.publish(scene);
  server.publish(heavy_scene());
  const int before = pictures();
  EXPECT_TRUE(eventually([&] { return pictures() >= before + 4; })) << "drawing goes on";
  viewer.signal(SIGTERM);
  const auto told = std::chrono::steady_clock::now();
  EXPECT_EQ(viewer.wait_for_end(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - told, std::chrono::seconds(20));
  EXPECT_GE(report("port")["others_refused"], 1);
}

TEST_F(ViewerProcess, OutlivesTheServerAndFindsTheNextOne) {
  auto server = std::make_unique<SeaServer>();
  ChildProcess viewer(command({"--channel", "port", "--every", "0.2"}));
  ASSERT_TRUE(eventually([&] { return pictures() >= 2; }));
  server.reset();
  const int at_loss = pictures();
  ASSERT_TRUE(eventually([&] { return pictures() >= at_loss + 18; })) << "goes on drawing without a server";
  server = std::make_unique<SeaServer>();
  const int at_return = pictures();
  ASSERT_TRUE(eventually([&] { return pictures() >= at_return + 20; }));
  viewer.signal(SIGTERM);
  EXPECT_EQ(viewer.wait_for_end(), 0);
  const json result = report("port");
  EXPECT_GT(result["seconds_without_server"], 0.1);
  EXPECT_LT(result["seconds_without_server"], result["seconds"].get<double>() - 0.5) << "it saw the second one";
}

TEST_F(ViewerProcess, GivesUpWithoutAServer) {
  ChildProcess viewer(command({"--channel", "centre", "--wait", "0.3"}));
  EXPECT_EQ(viewer.wait_for_end(), 1);
  EXPECT_THAT(report("centre")["errors"].dump(), testing::HasSubstr("no server on DDS domain"));
}

TEST_F(ViewerProcess, RefusesWhatItCannotUse) {
  EXPECT_EQ(ChildProcess(command({"--channel", "mast"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--size", "huge"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--rig", "none.json"})).wait_for_end(), 1);
  for (const char* utc : {"tomorrow", "2026-02-30T12:00", "2026-06-21", "2026-06-21T24:00", "1949-12-31T12:00",
                          "2026-06-21T12:00+02", "2026-06-21T12:00:61Z", "2026-06-21T12:00 "})
    EXPECT_EQ(ChildProcess(command({"--channel", "port", "--utc", utc})).wait_for_end(), 2) << utc;
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--cloud", "9"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--visibility", "0"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--delay", "-1"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--delay", "nan"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--clock", "ntp"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--rate", "0"})).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess({PELAGOS_VIEWER}).wait_for_end(), 2);
  EXPECT_EQ(ChildProcess({PELAGOS_VIEWER, "--version"}).wait_for_end(), 0);
  EXPECT_EQ(ChildProcess({PELAGOS_VIEWER, "--help"}).wait_for_end(), 0);
  std::ofstream(out_) << "a file where the folder should be";
  EXPECT_EQ(ChildProcess(command({"--channel", "port", "--synthetic", "--frames", "1"})).wait_for_end(), 1);
}

}  // namespace
}  // namespace pelagos
