#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "client/frame_receiver.hpp"
#include "pelagos_dds/participant.hpp"
#include "transport/frame_publisher.hpp"

namespace pelagos {

/// How long a test waits for what must come: far above what it takes (milliseconds), for a machine with other work.
inline constexpr std::chrono::seconds kPatience{20};

/// A domain of loopback that belongs to this process.
inline DdsSettings test_settings(DdsLog log = {}) {
  unsetenv("CYCLONEDDS_URI");  // whatever the machine is configured for, tests stay on loopback
  return {1 + static_cast<std::uint32_t>(getpid()) % 100, "", std::move(log)};
}

/// Calls `done` until it is true; false after kPatience.
template <class Condition>
[[nodiscard]] bool eventually(Condition&& done) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

inline SceneInfo test_scene() {
  SceneInfo info;
  info.scene = "tank";
  info.build = "test";
  info.seed = 42;
  info.particle_spacing = 0.5;
  info.water_level = 1.25;
  info.patch = {{-5.0, -4.0, 0.0}, {5.0, 4.0, 6.0}};
  info.tank_walls_visible = true;
  info.origin = {54.1, 12.1, 3.0};
  info.sea = WaveField({{0.5F, 0.2F, 1.4F, 0.7F, 2.0F}, {0.25F, 0.4F, 1.98F, 0.8F, 3.0F}}, info.water_level);
  info.bodies = {{1, "own ship", "hull.obj", 0.5}};
  return info;
}

inline std::unique_ptr<Snapshot> test_snapshot(FramePublisher& publisher, std::uint64_t frame, std::size_t particles) {
  auto snapshot = publisher.acquire();
  snapshot->frame = frame;
  snapshot->simulation_time = static_cast<double>(frame) / 30.0;
  snapshot->wall_time_ns = 1700000000000000000 + static_cast<std::int64_t>(frame);
  snapshot->origin = {1000.0, -2000.0, 0.5};
  snapshot->total_particles = static_cast<std::uint32_t>(3 * particles);
  snapshot->particles.resize(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    const auto x = static_cast<float>(i);
    snapshot->particles[i].position = {0.01F * x, 0.002F * x, -0.001F * x};
    snapshot->particles[i].velocity = {1.0F, 0.0F, -0.5F};
  }
  BodyState body;
  body.body = 1;
  body.position = {10.0, 20.0, 0.75};
  body.orientation = Eigen::Quaterniond(0.8, 0.0, 0.0, 0.6);
  body.velocity = {1.0, 2.0, 3.0};
  body.angular_velocity = {0.1, 0.2, 0.3};
  body.health = PoseHealth::kFresh;
  body.pose_age = 0.02;
  snapshot->bodies = {body};
  return snapshot;
}

/// Publisher and receiver that have found each other.
class Loopback : public testing::Test {
 protected:
  void start() {
    participant_ = join_dds(test_settings());
    publisher_ = std::make_unique<FramePublisher>(participant_, test_scene());
    receiver_ = std::make_unique<FrameReceiver>(test_settings());
    ASSERT_TRUE(eventually([this] { return publisher_->viewers() == 1 && receiver_->scene_info().has_value(); }));
  }

  /// Submits a frame and waits until the receiver has it; null if it never comes.
  std::unique_ptr<OceanFrame> pass(std::uint64_t frame, std::size_t particles) {
    publisher_->submit(test_snapshot(*publisher_, frame, particles));
    if (!receiver_->wait_for_frame(kPatience)) return nullptr;
    return receiver_->take_newest();
  }

  std::shared_ptr<DdsParticipant> participant_;
  std::unique_ptr<FramePublisher> publisher_;
  std::unique_ptr<FrameReceiver> receiver_;
};

}  // namespace pelagos
