#include "loopback.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <mutex>

#include "fields/field_difference.hpp"
#include "pelagos_dds/entities.hpp"
#include "waves/sea_state.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

constexpr double kRounding = 1e-12;  // a few multiplications of numbers around 1 in double

TEST_F(Loopback, FrameComesThroughWithBodiesAndHeader) {
  start();
  const auto frame = pass(7, 1000);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->source, publisher_->source());
  EXPECT_EQ(frame->frame, 7U);
  EXPECT_DOUBLE_EQ(frame->simulation_time, 7.0 / 30.0);
  EXPECT_EQ(frame->wall_time_ns, 1700000000000000007);
  EXPECT_EQ(frame->origin, Eigen::Vector3d(1000.0, -2000.0, 0.5));
  EXPECT_EQ(frame->total_particles, 3000U);
  ASSERT_EQ(frame->particles.size(), 1000U);
  EXPECT_NEAR(frame->particles[999].position.x(), 9.99F, 1e-4F);  // a step of the 10 m box is 0.15 mm
  EXPECT_NEAR(frame->box.max.x(), 9.99, 1e-4);
  ASSERT_EQ(frame->bodies.size(), 1U);
  const BodyState& body = frame->bodies[0];
  EXPECT_EQ(body.body, 1U);
  EXPECT_EQ(body.position, Eigen::Vector3d(10.0, 20.0, 0.75));
  EXPECT_LT(body.orientation.angularDistance(Eigen::Quaterniond(0.8, 0.0, 0.0, 0.6)), 1e-7);  // acos near 1
  EXPECT_EQ(body.velocity, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_TRUE(body.angular_velocity.isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), kRounding));
  EXPECT_EQ(body.health, PoseHealth::kFresh);
  EXPECT_DOUBLE_EQ(body.pose_age, 0.02);
}

TEST_F(Loopback, EveryFrameReachesAReaderThatKeepsUp) {
  start();
  constexpr std::uint64_t kFrames = 60;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    auto received = pass(frame, 2000);
    ASSERT_TRUE(received);
    ASSERT_EQ(received->frame, frame);
    receiver_->recycle(std::move(received));
  }
  EXPECT_EQ(receiver_->counters().received, kFrames);
  EXPECT_EQ(receiver_->counters().missed, 0U);
  EXPECT_EQ(receiver_->counters().refused, 0U);
  // The publisher counts a frame after it has been written, which may be after it has arrived.
  EXPECT_TRUE(eventually([this] { return publisher_->counters().published == kFrames; }));
  EXPECT_EQ(publisher_->counters().dropped, 0U);
}

TEST_F(Loopback, EmptyFrameIsAFrame) {
  start();
  const auto frame = pass(0, 0);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->particles.empty());
  EXPECT_EQ(frame->bodies.size(), 1U);
}

TEST_F(Loopback, LateViewerGetsTheScene) {
  start();
  ASSERT_TRUE(pass(0, 10));
  const FrameReceiver late(test_settings());
  ASSERT_TRUE(eventually([&] { return late.scene_info().has_value(); }));
  EXPECT_TRUE(eventually([&] { return late.server_alive(); }));
  EXPECT_GE(late.scene_revision(), 1U);  // the sea may come before or after it
  const SceneInfo sent = test_scene();
  const SceneInfo info = *late.scene_info();
  EXPECT_EQ(info.scene, sent.scene);
  EXPECT_EQ(info.build, sent.build);
  EXPECT_EQ(info.seed, sent.seed);
  EXPECT_EQ(info.frame_interval, sent.frame_interval);
  EXPECT_EQ(info.particle_spacing, sent.particle_spacing);
  EXPECT_EQ(info.water_level, sent.water_level);
  EXPECT_EQ(info.patch.min, sent.patch.min);
  EXPECT_EQ(info.patch.max, sent.patch.max);
  EXPECT_EQ(info.tank_walls_visible, sent.tank_walls_visible);
  EXPECT_EQ(info.origin.latitude_deg, sent.origin.latitude_deg);
  EXPECT_EQ(info.origin.longitude_deg, sent.origin.longitude_deg);
  EXPECT_EQ(info.origin.height, sent.origin.height);
  const auto difference = find_difference(info.sea, sent.sea);
  EXPECT_FALSE(difference.has_value()) << difference->field;
  ASSERT_EQ(info.bodies.size(), 1U);
  EXPECT_EQ(info.bodies[0].id, 1U);
  EXPECT_EQ(info.bodies[0].name, "own ship");
  EXPECT_EQ(info.bodies[0].mesh_file, "hull.obj");
  EXPECT_EQ(info.bodies[0].mesh_scale, 0.5);
}

/// The receiver has all of the sea that the server has.
testing::AssertionResult has_sea(const FrameReceiver& receiver, const WaveField& sea) {
  std::optional<FieldDifference> difference;
  const bool came = eventually([&] {
    const auto scene = receiver.scene_info();
    difference = scene ? find_difference(scene->sea, sea) : FieldDifference{"no scene", "", ""};
    return !difference;
  });
  if (came) return testing::AssertionSuccess();
  return testing::AssertionFailure() << difference->field << ": " << difference->one << " and " << difference->other;
}

TEST_F(Loopback, ViewersBlendTheSeaAsTheServerDoes) {
  start();
  WaveField sea = test_scene().sea;
  EXPECT_TRUE(has_sea(*receiver_, sea)) << "from the start on";
  const std::uint64_t revision = receiver_->scene_revision();
  ASSERT_TRUE(sea.exchange(make_wave_components({.beaufort = 6, .components = 128, .seed = 5}), 40.0, 30.0));
  publisher_->publish_sea(sea);
  EXPECT_TRUE(has_sea(*receiver_, sea));
  EXPECT_GT(receiver_->scene_revision(), revision);
  ASSERT_TRUE(sea.exchange({}, 50.0, 60.0)) << "while the first still runs";
  publisher_->publish_sea(sea);
  EXPECT_TRUE(has_sea(*receiver_, sea));

  const FrameReceiver late(test_settings());  // joins in the middle of both blends
  EXPECT_TRUE(has_sea(late, sea));
  ASSERT_TRUE(late.scene_info());
  const WaveMoment drawn = late.scene_info()->sea.at(63.0, {10.0, -4.0}), computed = sea.at(63.0, {10.0, -4.0});
  ASSERT_EQ(drawn.waves.size(), 130U) << "every component of both seas";
  EXPECT_EQ(std::memcmp(drawn.waves.data(), computed.waves.data(), drawn.waves.size() * sizeof(MomentWave)), 0);
}

TEST_F(Loopback, ASceneThatComesAgainLeavesTheSeaAsItIs) {
  start();
  WaveField sea = test_scene().sea;
  ASSERT_TRUE(sea.exchange({}, 40.0, 30.0));
  publisher_->publish_sea(sea);
  ASSERT_TRUE(has_sea(*receiver_, sea));
  SceneInfo again = test_scene();
  again.sea = sea;
  again.seed = 43;
  publisher_->publish_scene_info(again);
  ASSERT_TRUE(eventually([this] { return receiver_->scene_info()->seed == 43U; }));
  EXPECT_TRUE(has_sea(*receiver_, sea));
}

TEST_F(Loopback, ServerThatEndsIsNoticed) {
  start();
  ASSERT_TRUE(eventually([this] { return receiver_->server_alive(); }));
  publisher_.reset();
  EXPECT_TRUE(eventually([this] { return !receiver_->server_alive(); }));
}

TEST_F(Loopback, RestartedServerIsFollowed) {
  start();
  ASSERT_TRUE(pass(100, 10));
  publisher_ = std::make_unique<FramePublisher>(participant_, test_scene());
  // Frames of the new one are taken once the old one has been silent for 2 s.
  std::uint64_t next = 0;
  ASSERT_TRUE(eventually([&] {
    publisher_->submit(test_snapshot(*publisher_, next++, 10));
    const auto frame = receiver_->take_newest();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return frame && frame->source == publisher_->source();
  }));
  EXPECT_TRUE(eventually([this] { return receiver_->scene_info().has_value(); }));
}

TEST_F(Loopback, LateViewerOfAPausedSeaHasItsLastFrame) {
  start();
  ServerStatus paused;
  paused.paused = true;
  auto snapshot = test_snapshot(*publisher_, 41, 10);
  snapshot->oil.emplace().discs = {{0.0F, 1.0F, 0.0F, 2.0F, 1e-3F, 50.0F, 0.0F, {}, false}};
  publisher_->submit(std::move(snapshot));
  ASSERT_TRUE(receiver_->wait_for_frame(kPatience));
  ASSERT_TRUE(receiver_->take_newest());
  publisher_->submit_status(paused);

  FrameReceiver late(test_settings());
  ASSERT_TRUE(late.wait_for_frame(kPatience));
  const auto frame = late.take_newest();
  EXPECT_EQ(frame->frame, 41U);
  EXPECT_EQ(frame->particles.size(), 10U);
  ASSERT_EQ(frame->bodies.size(), 1U);
  EXPECT_EQ(frame->bodies[0].position, Eigen::Vector3d(10.0, 20.0, 0.75));
  EXPECT_TRUE(eventually([&] { return late.slick() && late.status() && late.status()->paused; }));
  EXPECT_EQ(late.slick()->discs.size(), 1U);
  // For who has it already it is a sign of life, not a frame.
  EXPECT_TRUE(eventually([&] { return receiver_->counters().repeated >= 2; }));
  EXPECT_EQ(receiver_->counters().received, 1U);
  EXPECT_EQ(receiver_->take_newest(), nullptr);
  EXPECT_TRUE(receiver_->server_alive());
  EXPECT_EQ(publisher_->counters().published, 1U);
}

TEST_F(Loopback, AServerThatStartsIsHeardBeforeItHasAScene) {
  participant_ = join_dds(test_settings());
  publisher_ = std::make_unique<FramePublisher>(participant_, std::nullopt);
  ServerStatus starting;
  starting.scene = "bay";
  publisher_->submit_status(starting);
  receiver_ = std::make_unique<FrameReceiver>(test_settings());
  ASSERT_TRUE(eventually([&] { return receiver_->status().has_value(); })) << "said again for a viewer that is late";
  EXPECT_EQ(receiver_->status()->scene, "bay");
  EXPECT_TRUE(receiver_->server_alive());
  EXPECT_FALSE(receiver_->scene_info());
  publisher_->publish_scene_info(test_scene());
  EXPECT_TRUE(eventually([&] { return receiver_->scene_info().has_value(); }));
}

TEST_F(Loopback, StatusWindAndEventsComeThrough) {
  start();
  ServerStatus sent;
  sent.scene = "tank";
  sent.step = 900;
  sent.frame = 30;
  sent.simulation_time = 1.5;
  sent.paused = true;
  sent.real_time_factor = 0.99;
  sent.largest_density = 1.02;
  sent.poses_refused = 4;
  sent.unconverged_steps = 7;
  sent.recoveries = 2;
  sent.effort = {0.005, 3e-4, 1e-3};
  sent.governed = sent.over_budget = true;
  WindSettings wind;
  wind.velocity = wind_velocity(12.0, 270.0);  // from west: blows east
  wind.amplitude = 2.0;
  wind.pulse = WindPulse{10.0, 4.0};
  sent.wind = wind;
  sent.bodies = test_snapshot(*publisher_, 0, 0)->bodies;
  Event event;
  event.sequence = 1;
  event.step = 900;
  event.simulation_time = 1.5;
  event.kind = "wind";
  event.source = "station 127.0.0.1:40112";
  event.text = "wind 12 m/s from 270";

  std::vector<Event> events;
  ASSERT_TRUE(eventually([&] {  // volatile topics: what is sent before the reader has matched is not kept for it
    publisher_->submit_status(sent);
    publisher_->publish_event(event);
    const auto more = receiver_->take_events();
    events.insert(events.end(), more.begin(), more.end());
    return receiver_->status() && receiver_->wind() && !events.empty();
  }));
  const ServerStatus status = *receiver_->status();
  EXPECT_EQ(status.scene, "tank");
  EXPECT_EQ(status.step, 900U);
  EXPECT_EQ(status.frame, 30U);
  EXPECT_TRUE(status.paused);
  EXPECT_EQ(status.real_time_factor, 0.99);
  EXPECT_EQ(status.largest_density, 1.02);
  EXPECT_EQ(status.poses_refused, 4U);
  EXPECT_EQ(status.unconverged_steps, 7U);
  EXPECT_EQ(status.recoveries, 2U);
  EXPECT_EQ(status.effort, (Effort{0.005, 3e-4, 1e-3}));
  EXPECT_TRUE(status.governed);
  EXPECT_TRUE(status.over_budget);
  EXPECT_EQ(status.frames_published, 0U);
  ASSERT_EQ(status.bodies.size(), 1U);
  EXPECT_EQ(status.bodies[0].pose_age, 0.02);
  ASSERT_TRUE(status.wind);
  EXPECT_NEAR(status.wind->velocity.x(), 12.0, kRounding);
  EXPECT_NEAR(receiver_->wind()->velocity.x(), 12.0, kRounding);
  EXPECT_EQ(receiver_->wind()->amplitude, 2.0);
  ASSERT_TRUE(receiver_->wind()->pulse);
  EXPECT_EQ(receiver_->wind()->pulse->width, 4.0);
  EXPECT_EQ(events[0].sequence, 1U);
  EXPECT_EQ(events[0].kind, "wind");
  EXPECT_EQ(events[0].source, event.source);
  EXPECT_EQ(events[0].text, event.text);

  sent.wind.reset();
  EXPECT_TRUE(eventually([&] {
    publisher_->submit_status(sent);
    return !receiver_->wind().has_value();
  }));
}

TEST_F(Loopback, BodiesMayTravelInNed) {
  participant_ = join_dds(test_settings());
  PublisherSettings settings;
  settings.bodies_in_ned = true;
  publisher_ = std::make_unique<FramePublisher>(participant_, test_scene(), settings);
  receiver_ = std::make_unique<FrameReceiver>(test_settings());
  ASSERT_TRUE(eventually([this] { return publisher_->viewers() == 1; }));
  const auto frame = pass(0, 1);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->bodies.size(), 1U);
  EXPECT_TRUE(frame->bodies[0].position.isApprox(Eigen::Vector3d(10.0, 20.0, 0.75), kRounding));
  EXPECT_TRUE(frame->bodies[0].angular_velocity.isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), kRounding));
}

TEST_F(Loopback, PublisherDropsTheOldestAndRecycles) {
  participant_ = join_dds(test_settings());
  publisher_ = std::make_unique<FramePublisher>(participant_, test_scene());
  for (std::uint64_t frame = 0; frame < 500; ++frame) publisher_->submit(test_snapshot(*publisher_, frame, 5000));
  ASSERT_TRUE(eventually([this] {
    const PublisherCounters counters = publisher_->counters();
    return counters.published + counters.dropped == 500;
  }));
  EXPECT_GE(publisher_->counters().published, 1U);
  EXPECT_EQ(publisher_->counters().failed, 0U);
  const auto reused = publisher_->acquire();
  EXPECT_GE(reused->particles.capacity(), 5000U);
  EXPECT_TRUE(reused->particles.empty());
  EXPECT_TRUE(reused->bodies.empty());
}

TEST_F(Loopback, UnfitParticlesAreCountedAndTheFrameGoesOn) {
  start();
  auto snapshot = test_snapshot(*publisher_, 0, 10);
  snapshot->particles[3].position.x() = std::numeric_limits<float>::quiet_NaN();
  publisher_->submit(std::move(snapshot));
  ASSERT_TRUE(receiver_->wait_for_frame(kPatience));
  EXPECT_EQ(receiver_->take_newest()->particles.size(), 9U);
  EXPECT_TRUE(eventually([this] { return publisher_->counters().refused_particles == 1; }));
}

/// A writer that sends frames as they must not be.
class HostileWriter : public testing::Test {
 protected:
  void SetUp() override {
    participant_ = join_dds(test_settings());
    writer_ = std::make_unique<DdsWriter>(*participant_, topics::ocean_frame());
    receiver_ = std::make_unique<FrameReceiver>(test_settings());
    ASSERT_TRUE(eventually([this] { return writer_->matched_readers() == 1; }));
    payload_.assign(100 * kRecordBytes, 7);
    body_ = wire::to_wire(BodyState{}, pelagos_FRAME_ENU);
    sample_.source = 99;
    sample_.box_size = {1.0F, 1.0F, 1.0F};
    sample_.particle_spacing = 0.5F;
    sample_.count = 100;
    sample_.record_bytes = kRecordBytes;
    sample_.payload._buffer = payload_.data();
    sample_.payload._length = sample_.payload._maximum = static_cast<std::uint32_t>(payload_.size());
    sample_.bodies._buffer = &body_;
    sample_.bodies._length = sample_.bodies._maximum = 1;
  }

  void expect_refused(const pelagos_OceanFrameV1& sample, const char* what) {
    const std::uint64_t before = receiver_->counters().refused;
    ASSERT_TRUE(writer_->write(&sample));
    EXPECT_TRUE(eventually([&] { return receiver_->counters().refused == before + 1; })) << what;
    EXPECT_EQ(receiver_->take_newest(), nullptr) << what;
  }

  std::shared_ptr<DdsParticipant> participant_;
  std::unique_ptr<DdsWriter> writer_;
  std::unique_ptr<FrameReceiver> receiver_;
  std::vector<std::uint8_t> payload_;
  pelagos_BodyStateV1 body_{};
  pelagos_OceanFrameV1 sample_{};
};

TEST_F(HostileWriter, FramesWithFaultsAreRefusedAndCounted) {
  const auto with = [this](auto&& change) {
    pelagos_OceanFrameV1 sample = sample_;
    change(sample);
    return sample;
  };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  expect_refused(with([](auto& s) { s.payload._length -= 1; }), "short payload");
  expect_refused(with([](auto& s) { s.payload._length = 0; }), "no payload");
  expect_refused(with([](auto& s) { s.count = 99; }), "count too small");
  expect_refused(with([](auto& s) { s.count = 0xFFFFFFFF; }), "count too large");
  expect_refused(with([](auto& s) { s.record_bytes = 16; }), "other records");
  expect_refused(with([](auto& s) { s.box_size.x = kNaN; }), "NaN box");
  expect_refused(with([](auto& s) { s.box_size.y = -1.0F; }), "negative box");
  expect_refused(with([](auto& s) { s.particle_spacing = 0.0F; }), "no spacing");
  expect_refused(with([](auto& s) { s.largest_speed = 1e30F; }), "absurd speed");
  expect_refused(with([](auto& s) { s.origin.z = kNaN; }), "NaN origin");
  body_.position.x = kNaN;
  expect_refused(sample_, "NaN body");
  body_ = wire::to_wire(BodyState{}, pelagos_FRAME_ENU);
  ASSERT_TRUE(writer_->write(&sample_));
  EXPECT_TRUE(receiver_->wait_for_frame(kPatience)) << "a good frame after the bad ones";
}

TEST_F(HostileWriter, SceneWithFaultsIsRefused) {
  const DdsWriter writer(*participant_, topics::scene_info());
  const SceneInfo scene = test_scene();  // the sample points into it
  const wire::SceneInfoSample good(scene, 99);
  std::vector<pelagos_SceneInfoV1> bad(4, good.get());
  bad[0].particle_spacing = 0.0;
  bad[1].frame_interval = std::numeric_limits<double>::quiet_NaN();
  bad[2].tank_max.x = std::numeric_limits<double>::infinity();
  bad[3].origin_latitude_deg = 91.0;
  for (const pelagos_SceneInfoV1& sample : bad) {
    EXPECT_TRUE(wire::find_fault(sample));
    ASSERT_TRUE(writer.write(&sample));
  }
  EXPECT_FALSE(wire::find_fault(good.get()));
  ASSERT_TRUE(writer.write(&good.get()));
  ASSERT_TRUE(eventually([this] { return receiver_->scene_info().has_value(); }));
  EXPECT_EQ(receiver_->scene_revision(), 1U);
}

TEST_F(HostileWriter, SecondServerIsIgnoredWhileTheFirstLives) {
  ASSERT_TRUE(writer_->write(&sample_));
  ASSERT_TRUE(receiver_->wait_for_frame(kPatience));
  ASSERT_TRUE(receiver_->take_newest());
  sample_.source = 98;
  ASSERT_TRUE(writer_->write(&sample_));
  EXPECT_TRUE(eventually([this] { return receiver_->counters().foreign == 1; }));
  EXPECT_EQ(receiver_->take_newest(), nullptr);
}

TEST_F(HostileWriter, ASecondProcessThatUsesTheSourceIsRefusedAndTold) {
  std::mutex mutex;
  std::vector<std::string> lines;
  receiver_ = std::make_unique<FrameReceiver>(test_settings([&](std::string_view line) {
    const std::lock_guard lock(mutex);
    lines.emplace_back(line);
  }));
  ASSERT_TRUE(eventually([this] { return writer_->matched_readers() >= 1; }));
  ASSERT_TRUE(eventually([this] {
    ++sample_.frame;
    (void)writer_->write(&sample_);
    return receiver_->take_newest() != nullptr;
  }));
  const auto stranger = join_dds(test_settings());
  const DdsWriter second(*stranger, topics::ocean_frame());
  pelagos_OceanFrameV1 forged = sample_;
  forged.frame = std::numeric_limits<std::uint64_t>::max();
  ASSERT_TRUE(eventually([&] {
    (void)second.write(&forged);
    return receiver_->counters().intruding >= 3;
  }));
  const auto own = receiver_->take_newest();  // there may be one
  EXPECT_TRUE(!own || own->frame == sample_.frame);
  EXPECT_EQ(receiver_->counters().jumps, 0U);
  ++sample_.frame;
  ASSERT_TRUE(writer_->write(&sample_));
  ASSERT_TRUE(receiver_->wait_for_frame(kPatience)) << "the first goes on";
  EXPECT_EQ(receiver_->counters().missed, 0U);
  const std::lock_guard lock(mutex);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.find("a second process sends frame") == 0; }),
            1);
}

TEST_F(HostileWriter, EachKindOfFaultIsToldOnce) {
  std::mutex mutex;
  std::string told;
  receiver_ = std::make_unique<FrameReceiver>(test_settings([&](std::string_view line) {
    const std::lock_guard lock(mutex);
    told += std::string(line) + "\n";
  }));
  ASSERT_TRUE(eventually([this] { return writer_->matched_readers() >= 1; }));
  sample_.record_bytes = 16;
  ASSERT_TRUE(eventually([&] {
    (void)writer_->write(&sample_);
    return receiver_->counters().refused >= 20;
  }));
  const std::lock_guard lock(mutex);
  const auto first = told.find("frame refused: record_bytes: is not 20");
  EXPECT_NE(first, std::string::npos) << told;
  EXPECT_EQ(told.find("frame refused: record_bytes", first + 1), std::string::npos);
}

}  // namespace
}  // namespace pelagos
