// A running server and bridges that send nonsense: the sea goes on, the hull stays, the instructor hears of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "../support/places.hpp"
#include "pelagos_dds/entities.hpp"
#include "running_program.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{60};

constexpr const char* kPond = R"(name: "pond" particle_spacing: 0.5
patch { min { x: -10 y: -7 z: -2 } max { x: 10 y: 7 z: 4 } }
patch_edges { x: MIRROR y: MIRROR z: MIRROR }
water { block { min { x: -10 y: -7 z: -2 } max { x: 10 y: 7 z: 0 } } settle_steps: 50 }
body { id: 1 name: "lighter" shape { box { size { x: 6 y: 3 z: 2 } } } drive: POSE position { x: 0 y: 0 z: 0 } }
frame_rate: 30
)";

class RogueBridge : public testing::Test {
 protected:
  RogueBridge() {
    unsetenv("CYCLONEDDS_URI");
    const std::string scene = (folder_.path() / "pond.scene").string();
    std::ofstream(scene) << kPond;
    server_ = std::make_unique<RunningProgram>(
        std::vector<std::string>{test::build_path("bin/pelagos-server"), "--scene", scene, "--domain",
                                 std::to_string(domain_), "--control", "127.0.0.1:0", "--threads", "1"});
    participant_ = std::make_unique<DdsParticipant>(DdsSettings{domain_, "", {}});
    poses_ = std::make_unique<DdsWriter>(*participant_, topics::own_ship_pose());
    loads_ = std::make_unique<DdsReader>(*participant_, topics::body_load());
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (poses_->matched_readers() == 0 && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  std::string where() {
    const std::string text = server_->errors(), mark = "control: listening on ";
    const std::size_t at = text.find(mark) + mark.size();
    return text.substr(at, text.find('\n', at) - at);
  }

  nlohmann::json status() {
    RunningProgram ctl({test::build_path("bin/pelagos-ctl"), "--server", where(), "--json", "status"});
    EXPECT_EQ(ctl.wait(kPatience), 0) << ctl.errors();
    return nlohmann::json::parse(ctl.output());
  }

  /// Sends poses at a rate; every load that comes back meanwhile must be finite.
  void send(double rate, double seconds, const std::function<void(BodyPose&, int)>& change, std::uint32_t sender = 5) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < static_cast<int>(rate * seconds); ++k) {
      std::this_thread::sleep_until(start + std::chrono::duration<double>(k / rate));
      BodyPose pose;
      pose.body = 1;
      pose.time = time_ += 1.0 / rate;
      change(pose, k);
      const pelagos_PoseV1 sample = wire::to_wire(pose, sender, pelagos_FRAME_ENU);
      EXPECT_TRUE(poses_->write(&sample));
      loads_->take_all<pelagos_BodyLoadV1>([&](const pelagos_BodyLoadV1& load) {
        ++loads_heard_;
        EXPECT_TRUE(std::isfinite(load.force.x + load.force.y + load.force.z + load.moment.x + load.moment.y));
      });
    }
  }

  std::uint32_t domain_ = 101 + static_cast<std::uint32_t>(getpid()) % 60;
  TemporaryFolder folder_;
  std::unique_ptr<RunningProgram> server_;
  std::unique_ptr<DdsParticipant> participant_;
  std::unique_ptr<DdsWriter> poses_;
  std::unique_ptr<DdsReader> loads_;
  double time_ = 0.0;
  int loads_heard_ = 0;
};

TEST_F(RogueBridge, CostsTheSeaNothingAndMovesNoHull) {
  send(60.0, 2.5, [](BodyPose&, int) {});
  const nlohmann::json quiet = status();
  send(60.0, 5.0, [](BodyPose& pose, int k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    pose.velocity = {sign * 199.0, 0.0, 0.0};
    pose.angular_velocity = {0.0, 0.0, sign * 19.0};
    if (k % 7 == 3) pose.position = {sign * 9.0, 4.0, 1.0};
  });
  const nlohmann::json rogue = status();
  // Steps are as long as before, so the sea is as fast as before.
  EXPECT_GT(rogue.at("time_step").get<double>(), 0.9 * quiet.at("time_step").get<double>());
  const nlohmann::json place = rogue.at("body").at(0).at("position");
  EXPECT_LT(std::hypot(place.at("x").get<double>(), place.at("y").get<double>()), 1.0);
  EXPECT_LT(std::abs(place.at("z").get<double>()), 1.0);
  EXPECT_GT(rogue.at("poses_corrected").get<int>(), 50);
  EXPECT_GT(rogue.at("poses_refused").get<int>(), 20);
  EXPECT_THAT(rogue.at("pose_refusals").dump(), HasSubstr("leaps"));
  EXPECT_GT(loads_heard_, 30);
  EXPECT_THAT(server_->errors(), HasSubstr("contradicts its places"));
  std::this_thread::sleep_for(std::chrono::seconds(4));  // and nothing carries it off when the poses end
  EXPECT_LT(std::abs(status().at("body").at(0).at("position").at("x").get<double>()), 1.0);
}

TEST_F(RogueBridge, FillsNoLog) {
  send(2000.0, 4.0, [](BodyPose& pose, int k) {
    pose.velocity = {k % 2 == 0 ? 199.0 : -199.0, 0.0, 0.0};
    if (k % 3 == 1) pose.body = 77;
    if (k % 5 == 2) pose.position.x() = std::nan("");
    if (k % 7 == 3) pose.position.x() = 9.0;
    if (k % 11 == 4) pose.time = -1.0;
  });
  const std::string lines = server_->errors();
  EXPECT_LT(std::count(lines.begin(), lines.end(), '\n'), 60) << lines;
  EXPECT_GT(status().at("poses_refused").get<int>(), 1000);
}

}  // namespace
}  // namespace pelagos
