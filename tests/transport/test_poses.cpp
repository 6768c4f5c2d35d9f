#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "loopback.hpp"
#include "pelagos_dds/entities.hpp"
#include "transport/local_plane.hpp"
#include "transport/pose_gate.hpp"
#include "transport/pose_receiver.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using namespace std::chrono_literals;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kSender = 5;
constexpr GeodeticOrigin kOrigin{38.86, 121.75, 10.0};

BodyPose pose_at(double time) {
  BodyPose pose;
  pose.body = 1;
  pose.time = time;
  return pose;
}

class PoseGateTest : public testing::Test {
 protected:
  std::optional<PoseFault> check(BodyPose pose, std::uint32_t sender = kSender, std::chrono::milliseconds later = 0ms) {
    return gate_.check(pose, {sender}, start_ + later);
  }
  std::uint64_t refused(PoseFault fault) const { return gate_.counters().refused[static_cast<std::size_t>(fault)]; }

  PoseGate gate_{{1, 2}};
  PoseGate::Clock::time_point start_ = PoseGate::Clock::now();
};

TEST_F(PoseGateTest, GoodPosesPass) {
  EXPECT_EQ(check(pose_at(1.0)), std::nullopt);
  EXPECT_EQ(check(pose_at(1.1)), std::nullopt);
  EXPECT_EQ(gate_.counters().accepted, 2U);
  EXPECT_EQ(gate_.counters().refused_in_all(), 0U);
}

TEST_F(PoseGateTest, EachFaultIsNamedAndCounted) {
  const auto with = [](auto&& change) {
    BodyPose pose = pose_at(1.0);
    change(pose);
    return pose;
  };
  EXPECT_EQ(check(with([](BodyPose& p) { p.body = 3; })), PoseFault::kUnknownBody);
  EXPECT_EQ(check(with([](BodyPose& p) { p.position.x() = kNaN; })), PoseFault::kNotFinite);
  EXPECT_EQ(check(with([](BodyPose& p) { p.orientation.w() = kNaN; })), PoseFault::kNotFinite);
  EXPECT_EQ(check(with([](BodyPose& p) { p.velocity.y() = std::numeric_limits<double>::infinity(); })),
            PoseFault::kNotFinite);
  EXPECT_EQ(check(with([](BodyPose& p) { p.angular_velocity.z() = kNaN; })), PoseFault::kNotFinite);
  EXPECT_EQ(check(with([](BodyPose& p) { p.time = kNaN; })), PoseFault::kNotFinite);
  EXPECT_EQ(check(with([](BodyPose& p) { p.orientation.coeffs().setZero(); })), PoseFault::kNotUnit);
  EXPECT_EQ(check(with([](BodyPose& p) { p.orientation.w() = 1.02; })), PoseFault::kNotUnit);
  EXPECT_EQ(check(with([](BodyPose& p) { p.orientation.w() = 1e300; })), PoseFault::kNotUnit);
  EXPECT_EQ(check(with([](BodyPose& p) { p.position.z() = -1.1e5; })), PoseFault::kTooFar);
  EXPECT_EQ(check(with([](BodyPose& p) { p.velocity.x() = 201.0; })), PoseFault::kTooFast);
  EXPECT_EQ(check(with([](BodyPose& p) { p.velocity.x() = 1e300; })), PoseFault::kTooFast);
  EXPECT_EQ(check(with([](BodyPose& p) { p.angular_velocity.x() = 21.0; })), PoseFault::kSpinsTooFast);
  EXPECT_EQ(gate_.counters().accepted, 0U);
  EXPECT_EQ(refused(PoseFault::kNotFinite), 5U);
  EXPECT_EQ(refused(PoseFault::kNotUnit), 3U);
  EXPECT_EQ(gate_.counters().refused_in_all(), 13U);
}

TEST_F(PoseGateTest, TimeMustIncreaseForEachBody) {
  EXPECT_EQ(check(pose_at(5.0)), std::nullopt);
  EXPECT_EQ(check(pose_at(5.0)), PoseFault::kTimeNotLater);
  EXPECT_EQ(check(pose_at(4.9)), PoseFault::kTimeNotLater);
  BodyPose other = pose_at(1.0);
  other.body = 2;
  EXPECT_EQ(check(other), std::nullopt);
}

TEST_F(PoseGateTest, RestartedSenderIsTakenAfterSilence) {
  EXPECT_EQ(check(pose_at(500.0), kSender, 0ms), std::nullopt);
  EXPECT_EQ(check(pose_at(0.0), kSender, 400ms), PoseFault::kTimeNotLater);
  EXPECT_EQ(check(pose_at(0.1), kSender, 600ms), std::nullopt);
}

TEST_F(PoseGateTest, StandbySenderTakesOverAfterSilence) {
  EXPECT_EQ(check(pose_at(1.0), 5, 0ms), std::nullopt);
  EXPECT_EQ(check(pose_at(2.0), 6, 100ms), PoseFault::kSecondSender);
  EXPECT_EQ(check(pose_at(1.4), 5, 400ms), std::nullopt);
  EXPECT_EQ(check(pose_at(2.4), 6, 500ms), PoseFault::kSecondSender);
  EXPECT_EQ(check(pose_at(3.0), 6, 1000ms), std::nullopt);
  EXPECT_EQ(check(pose_at(3.0), 5, 1100ms), PoseFault::kSecondSender);
}

TEST_F(PoseGateTest, NearlyUnitQuaternionIsMadeUnit) {
  BodyPose pose = pose_at(1.0);
  pose.orientation.coeffs() *= 1.005;
  EXPECT_EQ(gate_.check(pose, {kSender}, start_), std::nullopt);
  EXPECT_NEAR(pose.orientation.norm(), 1.0, 1e-15);  // rounding
}

class PoseLoopback : public testing::Test {
 protected:
  void SetUp() override {
    participant_ = join_dds(test_settings());
    receiver_ =
        std::make_unique<PoseReceiver>(participant_, std::vector<std::uint32_t>{1, 2}, kOrigin, [this](auto line) {
          const std::lock_guard lock(mutex_);
          lines_.emplace_back(line);
        });
    own_ship_ = std::make_unique<DdsWriter>(*participant_, topics::own_ship_pose());
    other_ = std::make_unique<DdsWriter>(*participant_, topics::body_pose());
    geodetic_ = std::make_unique<DdsWriter>(*participant_, topics::geodetic_pose());
    ASSERT_TRUE(eventually([this] {
      return own_ship_->matched_readers() == 1 && other_->matched_readers() == 1 && geodetic_->matched_readers() == 1;
    }));
  }

  bool send(const BodyPose& pose, const DdsWriter& writer) {
    const pelagos_PoseV1 sample = wire::to_wire(pose, kSender, pelagos_FRAME_NED);
    return writer.write(&sample);
  }

  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::shared_ptr<DdsParticipant> participant_;
  std::unique_ptr<DdsWriter> own_ship_;
  std::unique_ptr<DdsWriter> other_;
  std::unique_ptr<DdsWriter> geodetic_;
  std::unique_ptr<PoseReceiver> receiver_;
};

TEST_F(PoseLoopback, NewestPoseOfEachBodyArrivesInEnu) {
  BodyPose own = pose_at(1.0);
  own.position = {10.0, 20.0, 1.0};
  BodyPose target = pose_at(1.0);
  target.body = 2;
  ASSERT_TRUE(send(own, *own_ship_));
  own.time = 2.0;
  own.position = {11.0, 20.0, 1.0};
  ASSERT_TRUE(send(own, *own_ship_));
  ASSERT_TRUE(send(target, *other_));
  ASSERT_TRUE(eventually([this] { return receiver_->counters().accepted == 3; }));
  std::vector<ReceivedPose> poses;
  receiver_->take_newest(poses);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].pose.body, 1U);
  EXPECT_EQ(poses[0].pose.time, 2.0);
  EXPECT_EQ(poses[0].sender, kSender);
  EXPECT_TRUE(poses[0].pose.position.isApprox(Eigen::Vector3d(11.0, 20.0, 1.0)));
  EXPECT_EQ(poses[1].pose.body, 2U);
  receiver_->take_newest(poses);
  EXPECT_TRUE(poses.empty());
}

TEST_F(PoseLoopback, BadPosesAreRefusedCountedAndLogged) {
  BodyPose bad = pose_at(1.0);
  bad.position.x() = kNaN;
  ASSERT_TRUE(send(bad, *own_ship_));
  bad = pose_at(1.0);
  bad.body = 77;
  ASSERT_TRUE(send(bad, *other_));
  ASSERT_TRUE(send(pose_at(1.0), *own_ship_));
  ASSERT_TRUE(eventually([this] { return receiver_->counters().accepted == 1; }));
  ASSERT_TRUE(eventually([this] { return receiver_->counters().refused_in_all() == 2; }));
  const PoseCounters counters = receiver_->counters();
  EXPECT_EQ(counters.refused[static_cast<std::size_t>(PoseFault::kNotFinite)], 1U);
  EXPECT_EQ(counters.refused[static_cast<std::size_t>(PoseFault::kUnknownBody)], 1U);
  const auto logged = [this](const char* text) {
    const std::lock_guard lock(mutex_);
    return std::any_of(lines_.begin(), lines_.end(),
                       [text](const std::string& line) { return line.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(eventually([&] { return logged("body 77 from sender 5 refused"); }));
  EXPECT_TRUE(eventually([&] { return logged("not finite"); }));
}

pelagos_GeodeticPoseV1 geodetic_sample(double latitude_deg, double longitude_deg) {
  pelagos_GeodeticPoseV1 sample{};
  sample.body = 1;
  sample.sender = kSender;
  sample.time = 1.0;
  sample.latitude_deg = latitude_deg;
  sample.longitude_deg = longitude_deg;
  sample.height = kOrigin.height;
  sample.orientation = {0.0, 0.0, 0.0, 1.0};   // heads north, upright
  sample.velocity = {5.0, 0.0, 0.0};           // to the north
  sample.angular_rate_body = {0.0, 0.0, 0.1};  // turns to starboard
  return sample;
}

TEST_F(PoseLoopback, GeodeticPosesAreTurnedIntoTheWorld) {
  constexpr double kMetresPerDegree = 111e3;  // of latitude there
  const auto start = PoseGate::Clock::now();
  std::vector<ReceivedPose> poses;
  std::optional<BodyPose> last;
  ASSERT_TRUE(eventually([&] {  // until its places have borne the velocity out
    const double time = std::chrono::duration<double>(PoseGate::Clock::now() - start).count();
    const double latitude = kOrigin.latitude_deg + 0.01 + 5.0 * time / kMetresPerDegree;
    pelagos_GeodeticPoseV1 sample = geodetic_sample(latitude, kOrigin.longitude_deg);
    sample.time = 1.0 + time;
    sample.orientation = {0.0, 0.0, std::sin(0.05 * time), std::cos(0.05 * time)};
    EXPECT_TRUE(geodetic_->write(&sample));
    std::this_thread::sleep_for(5ms);
    receiver_->take_newest(poses);
    if (!poses.empty()) last = poses[0].pose;
    return last && last->velocity.norm() > 4.99 && last->angular_velocity.norm() > 0.0999;
  }));
  EXPECT_NEAR(last->position.x(), 0.0, 1e-6);
  EXPECT_NEAR(last->position.y(), 1110.0 + 5.0 * (last->time - 1.0), 1.5);  // a hundredth of a degree at 38.86 north
  const double heading = 0.1 * (last->time - 1.0);
  EXPECT_TRUE((last->orientation * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d(std::sin(heading), std::cos(heading), 0.0), 1e-3));
  EXPECT_TRUE(last->velocity.isApprox(Eigen::Vector3d(0.0, 5.0, 0.0), 1e-3));
  EXPECT_TRUE(last->angular_velocity.isApprox(Eigen::Vector3d(0.0, 0.0, -0.1), 1e-3));
}

TEST_F(PoseLoopback, TwoBridgesWithOneNumberAreTwo) {
  DdsSettings settings = test_settings();
  const auto other_process = join_dds(settings);
  const DdsWriter second(*other_process, topics::body_pose());
  ASSERT_TRUE(eventually([&] { return second.matched_readers() == 1; }));
  ASSERT_TRUE(send(pose_at(1.0), *own_ship_));
  ASSERT_TRUE(eventually([this] { return receiver_->counters().accepted == 1; }));
  double time = 1.0;
  const auto refused = [this] {
    return receiver_->counters().refused[static_cast<std::size_t>(PoseFault::kSecondSender)];
  };
  ASSERT_TRUE(eventually([&] {
    time += 0.1;
    (void)send(pose_at(time), *own_ship_);
    (void)send(pose_at(time + 0.05), second);
    return refused() > 2;
  }));
  EXPECT_TRUE(eventually([this] {
    const std::lock_guard lock(mutex_);
    return std::any_of(lines_.begin(), lines_.end(), [](const std::string& line) {
      return line.find("another sender drives this body: another program that sends as 5") != std::string::npos;
    });
  }));
  // The first falls silent: the second takes over.
  const std::uint64_t before = receiver_->counters().accepted;
  EXPECT_TRUE(eventually([&] {
    time += 0.1;
    (void)send(pose_at(time), second);
    std::this_thread::sleep_for(10ms);
    return receiver_->counters().accepted > before + 2;
  }));
}

TEST_F(PoseLoopback, PlacesThatAreNoneAreRefused) {
  for (const double latitude : {90.1, kNaN}) {
    const pelagos_GeodeticPoseV1 sample = geodetic_sample(latitude, 0.0);
    ASSERT_TRUE(geodetic_->write(&sample));
    ASSERT_TRUE(eventually([this] { return receiver_->counters().refused_in_all() > 0; }));
  }
  const pelagos_GeodeticPoseV1 antipode = geodetic_sample(-kOrigin.latitude_deg, kOrigin.longitude_deg - 180.0);
  ASSERT_TRUE(geodetic_->write(&antipode));
  EXPECT_TRUE(
      eventually([this] { return receiver_->counters().refused[static_cast<std::size_t>(PoseFault::kTooFar)] == 1; }));
  EXPECT_GE(receiver_->counters().refused[static_cast<std::size_t>(PoseFault::kNoPlace)], 1U);
  EXPECT_EQ(receiver_->counters().accepted, 0U);
}

/// Earth-centred coordinates of a place (WGS84: a = 6,378,137 m, f = 1 / 298.257223563), the textbook's closed form.
Eigen::Vector3d earth_centred(double latitude_deg, double longitude_deg, double height) {
  constexpr double kAxis = 6378137.0, kFlattening = 1.0 / 298.257223563, kDegree = EIGEN_PI / 180.0;
  const double e2 = kFlattening * (2.0 - kFlattening);
  const double phi = latitude_deg * kDegree, lambda = longitude_deg * kDegree;
  const double n = kAxis / std::sqrt(1.0 - e2 * std::sin(phi) * std::sin(phi));
  return {(n + height) * std::cos(phi) * std::cos(lambda), (n + height) * std::cos(phi) * std::sin(lambda),
          (n * (1.0 - e2) + height) * std::sin(phi)};
}

TEST(LocalPlane, IsTangentToTheEllipsoid) {
  const LocalPlane plane(kOrigin);
  GeodeticPose pose;
  pose.latitude_deg = kOrigin.latitude_deg + 0.1;
  pose.longitude_deg = kOrigin.longitude_deg - 0.2;
  pose.height = -3.0;
  pose.velocity = {0.0, 0.0, 1.0};
  const Eigen::Vector3d way = earth_centred(pose.latitude_deg, pose.longitude_deg, pose.height) -
                              earth_centred(kOrigin.latitude_deg, kOrigin.longitude_deg, kOrigin.height);
  const double phi = kOrigin.latitude_deg * EIGEN_PI / 180.0, lambda = kOrigin.longitude_deg * EIGEN_PI / 180.0;
  const Eigen::Vector3d east(-std::sin(lambda), std::cos(lambda), 0.0);
  const Eigen::Vector3d up(std::cos(phi) * std::cos(lambda), std::cos(phi) * std::sin(lambda), std::sin(phi));
  const BodyPose world = plane.to_world(pose);
  EXPECT_NEAR(world.position.x(), way.dot(east), 1e-6);
  EXPECT_NEAR(world.position.y(), way.dot(up.cross(east)), 1e-6);
  EXPECT_NEAR(world.position.z(), way.dot(up), 1e-6);
  // Up at a place north and west of the origin leans that way in the origin's plane.
  EXPECT_NEAR(world.velocity.norm(), 1.0, 1e-12);
  EXPECT_GT(world.velocity.y(), 1e-3);
  EXPECT_LT(world.velocity.x(), -1e-3);
}

TEST_F(PoseLoopback, ManyBadPosesOfOneKindDoNotHideAnother) {
  BodyPose bad = pose_at(1.0);
  bad.position.x() = kNaN;
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(send(bad, *own_ship_));
  ASSERT_TRUE(eventually([this] { return receiver_->counters().refused_in_all() > 0; }));
  bad = pose_at(1.0);
  bad.body = 77;
  ASSERT_TRUE(send(bad, *other_));
  EXPECT_TRUE(eventually([this] {
    const std::lock_guard lock(mutex_);
    return std::any_of(lines_.begin(), lines_.end(),
                       [](const std::string& line) { return line.find("body 77") != std::string::npos; });
  }));
}

TEST_F(PoseLoopback, FloodWithUnknownBodiesEndsWithTheNewestPoseAndFewLines) {
  for (std::uint32_t i = 1; i <= 10000; ++i) {
    BodyPose noise = pose_at(i);
    noise.body = 1000 + i;  // a new key each time: the reader's memory must stay bounded
    (void)send(noise, *other_);
    (void)send(pose_at(i), *own_ship_);
  }
  std::vector<ReceivedPose> poses;
  EXPECT_TRUE(eventually([&] {
    receiver_->take_newest(poses);
    return !poses.empty() && poses.back().pose.time == 10000.0;
  }));
  const std::lock_guard lock(mutex_);
  EXPECT_LE(lines_.size(), 20U);  // five for each 10 s, and a summary: two windows on a slow machine, and some more
}

}  // namespace
}  // namespace pelagos
