// Viewers in other processes, over the loopback network, and what becomes of the others when one goes bad.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "../support/places.hpp"
#include "child_process.hpp"
#include "loopback.hpp"
#include "transport/pose_receiver.hpp"

namespace pelagos {
namespace {

using namespace std::chrono_literals;

// Two frames of this size are above the 500 kB at which the library's writers begin to hold back by default.
constexpr std::size_t kParticles = 20000;

class Processes : public testing::Test {
 protected:
  void SetUp() override {
    participant_ = join_dds(test_settings());
    publisher_ = std::make_unique<FramePublisher>(participant_, test_scene());
  }

  static std::unique_ptr<ChildProcess> start_reader() {
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{PELAGOS_TEST_PEER, "viewer", std::to_string(test_settings().domain)});
  }

  /// Submits the next frame and gives the readers time to take it.
  void publish_one() {
    publisher_->submit(test_snapshot(*publisher_, next_frame_++, kParticles));
    std::this_thread::sleep_for(5ms);
  }

  /// Publishes until each of `readers` has shown at least `frames` more frames.
  bool publish_until_seen(const std::vector<ChildProcess*>& readers, int frames) {
    std::vector<int> seen(readers.size(), 0);
    return eventually([&] {
      publish_one();
      bool all = true;
      for (std::size_t i = 0; i < readers.size(); ++i) {
        const std::string text = readers[i]->read_output(0ms);
        for (std::size_t at = text.find("frame "); at != std::string::npos; at = text.find("frame ", at + 1)) ++seen[i];
        all = all && seen[i] >= frames;
      }
      return all;
    });
  }

  std::shared_ptr<DdsParticipant> participant_;
  std::unique_ptr<FramePublisher> publisher_;
  std::uint64_t next_frame_ = 0;
};

TEST_F(Processes, KilledViewerDisturbsNobody) {
  const auto victim = start_reader();
  const auto witness = start_reader();
  ASSERT_TRUE(publish_until_seen({victim.get(), witness.get()}, 5));
  victim->signal(SIGKILL);
  EXPECT_EQ(victim->wait_for_end(), 128 + SIGKILL);
  // The dead one stays matched for up to 10 s: the frames of these are written to it as well.
  EXPECT_TRUE(publish_until_seen({witness.get()}, 50));
  EXPECT_EQ(publisher_->counters().failed, 0U);
}

TEST_F(Processes, StoppedViewerDisturbsNobodyAndComesBack) {
  const auto sleeper = start_reader();
  const auto witness = start_reader();
  ASSERT_TRUE(publish_until_seen({sleeper.get(), witness.get()}, 5));
  sleeper->signal(SIGSTOP);
  (void)sleeper->read_output(0ms);  // what it had printed before
  EXPECT_TRUE(publish_until_seen({witness.get()}, 50));
  EXPECT_EQ(publisher_->counters().failed, 0U);
  sleeper->signal(SIGCONT);
  EXPECT_TRUE(publish_until_seen({sleeper.get(), witness.get()}, 5));
}

TEST_F(Processes, SlowViewerGetsNewFramesAndTheWriterGoesOn) {
  FrameReceiver slow(test_settings());  // takes no frame for a long time
  const auto witness = start_reader();
  ASSERT_TRUE(publish_until_seen({witness.get()}, 60));
  ASSERT_TRUE(eventually([&] { return slow.counters().received >= 40; }));
  const ReceiverCounters counters = slow.counters();
  EXPECT_GE(counters.replaced + 16, counters.received) << "sixteen wait";
  EXPECT_GE(slow.take_newest()->frame + 2, counters.received);
  EXPECT_EQ(publisher_->counters().failed, 0U);
}

TEST(ServerProcess, KilledServerIsNoticed) {
  FrameReceiver receiver(test_settings());
  const auto server = std::make_unique<ChildProcess>(
      std::vector<std::string>{PELAGOS_TEST_PEER, "server", std::to_string(test_settings().domain)});
  ASSERT_TRUE(receiver.wait_for_frame(kPatience));
  ASSERT_TRUE(eventually([&] { return receiver.server_alive(); }));
  server->signal(SIGKILL);
  const auto killed = std::chrono::steady_clock::now();
  ASSERT_TRUE(eventually([&] { return !receiver.server_alive(); }));
  // After 2 s of silence; the participant itself would be missed after 10 s only.
  EXPECT_LT(std::chrono::steady_clock::now() - killed, 8s);
}

/// Longer than the lease of the server's liveliness and than the silence after which it counts as gone.
constexpr auto kBreak = 3s;

TEST(ServerProcess, AfterABreakTheFirstSampleIsASignOfLife) {
  FrameReceiver receiver(test_settings());
  const ChildProcess server({PELAGOS_TEST_PEER, "server", std::to_string(test_settings().domain)});
  ASSERT_TRUE(receiver.wait_for_frame(kPatience));
  ASSERT_TRUE(eventually([&] { return receiver.server_alive() && receiver.scene_info().has_value(); }));
  server.signal(SIGSTOP);
  std::this_thread::sleep_for(kBreak);
  (void)receiver.take_newest();
  EXPECT_FALSE(receiver.server_alive());
  const std::uint64_t revision = receiver.scene_revision();
  server.signal(SIGCONT);
  for (int frame = 0; frame < 20; ++frame) {
    ASSERT_TRUE(receiver.wait_for_frame(kPatience));
    EXPECT_TRUE(receiver.server_alive()) << "with each frame after the break";
    (void)receiver.take_newest();
  }
  EXPECT_EQ(receiver.scene_revision(), revision) << "nothing but frames was needed";
}

TEST_F(Processes, AViewerThatWasStoppedSeesTheServerAtOnce) {
  const auto viewer = start_reader();
  ASSERT_TRUE(publish_until_seen({viewer.get()}, 5));
  viewer->signal(SIGSTOP);
  const auto end = std::chrono::steady_clock::now() + kBreak;
  while (std::chrono::steady_clock::now() < end) publish_one();
  (void)viewer->read_output(0ms);
  viewer->signal(SIGCONT);
  std::string text;
  ASSERT_TRUE(eventually([&] {
    publish_one();
    text += viewer->read_output(0ms);
    return std::count(text.begin(), text.end(), '\n') >= 20;
  }));
  EXPECT_EQ(text.find("no server"), std::string::npos) << text;
}

TEST_F(Processes, ExampleBridgeIsHeardAndEndsByItself) {
  PoseReceiver receiver(participant_, {1});
  ChildProcess bridge({PELAGOS_EXAMPLE_BRIDGE, "--domain", std::to_string(test_settings().domain), "--duration", "1",
                       "--rate", "60", "--radius", "10", "--speed", "2", "--draft", "1"});
  std::vector<ReceivedPose> poses;
  BodyPose pose;
  ASSERT_TRUE(eventually([&] {  // until its places have borne out its velocity
    receiver.take_newest(poses);
    if (!poses.empty()) pose = poses[0].pose;
    return pose.velocity.head<2>().norm() > 1.999 && pose.angular_velocity.z() < -0.15;
  }));
  EXPECT_NEAR(pose.position.head<2>().norm(), 10.0, 1e-6);  // on the circle
  EXPECT_NEAR(pose.position.z(), -1.0, 0.1 + 1e-6);         // draft and the heave's amplitude
  EXPECT_NEAR(pose.velocity.head<2>().norm(), 2.0, 1e-3);   // differences over 2 ms
  EXPECT_NEAR(pose.angular_velocity.z(), -0.2, 0.05);       // speed / radius, clockwise; the roll and pitch tilt it
  // Runs along its bow, within the pitch of 1.5 degrees.
  EXPECT_GT((pose.orientation * Eigen::Vector3d::UnitX()).dot(pose.velocity.normalized()), 0.99);
  EXPECT_EQ(bridge.wait_for_end(), 0);
  EXPECT_EQ(receiver.counters().refused_in_all(), 0U);
  EXPECT_EQ(receiver.counters().corrected, 0U);
}

/// A domain that deploy/dds-security has closed; the processes find its configuration in their environment.
class ClosedDomain : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v openssl > /dev/null") != 0) GTEST_SKIP() << "there is no openssl";
    folder_ = std::filesystem::path(testing::TempDir()) / ("keys_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    const std::string script = test::source_path("deploy/dds-security");
    ASSERT_EQ(std::system((script + " " + folder_.string() + " > /dev/null").c_str()), 0);
  }
  void TearDown() override {
    unsetenv("CYCLONEDDS_URI");
    std::filesystem::remove_all(folder_);
  }

  /// A peer with the key of `role`; without one if that is empty.
  [[nodiscard]] std::unique_ptr<ChildProcess> start(const std::string& peer, const std::string& role) const {
    const std::string domain = std::to_string(test_settings().domain);
    if (!role.empty()) setenv("CYCLONEDDS_URI", ("file://" + (folder_ / (role + ".xml")).string()).c_str(), 1);
    auto process = std::make_unique<ChildProcess>(std::vector<std::string>{PELAGOS_TEST_PEER, peer, domain});
    unsetenv("CYCLONEDDS_URI");
    return process;
  }

  std::filesystem::path folder_;
};

TEST_F(ClosedDomain, WhoHasNoKeySeesNothingAndAKeyIsForItsRole) {
  const auto server = start("server", "server");
  const auto viewer = start("viewer", "viewer");
  const auto stranger = start("viewer", "");
  std::string seen;
  ASSERT_TRUE(eventually([&] {
    seen += viewer->read_output(20ms);
    return std::count(seen.begin(), seen.end(), '\n') >= 20;
  }));
  EXPECT_EQ(stranger->read_output(500ms), "");
  EXPECT_NE(start("server", "viewer")->wait_for_end(), 0) << "a viewer's key is not for frames";
}

}  // namespace
}  // namespace pelagos
