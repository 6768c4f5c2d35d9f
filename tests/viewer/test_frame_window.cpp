#include "source/frame_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "packing/particle_codec.hpp"
#include "source/frame_source.hpp"

namespace pelagos {
namespace {

constexpr double kInterval = 1.0 / 30.0;  // s
constexpr std::int64_t kMs = 1'000'000;

class Window : public testing::Test {
 protected:
  FrameWindow window_{[this](std::unique_ptr<OceanFrame> frame) { gone_.push_back(frame->frame); }};
  std::vector<std::uint64_t> gone_;

  void add(std::uint64_t number, double time, std::int64_t completed_ms = 0, std::uint64_t source = 1) {
    auto frame = std::make_unique<OceanFrame>();
    frame->source = source;
    frame->frame = number;
    frame->simulation_time = time;
    frame->completed_ns = completed_ms * kMs;
    frame->received_ns = completed_ms * kMs;
    BodyState body;
    body.body = 1;
    body.position = {10.0 * time, 0.0, 0.0};
    body.velocity = {10.0, 0.0, 0.0};
    body.orientation = Eigen::AngleAxisd(0.5 * time, Eigen::Vector3d::UnitZ());
    body.angular_velocity = {0.0, 0.0, 0.5};
    frame->bodies = {body};
    window_.add(std::move(frame));
  }
  [[nodiscard]] static DueInstant due(double time, std::int64_t era_begin_ms = -1'000'000,
                                      std::int64_t era_end_ms = 1'000'000) {
    return {{time, 1, era_begin_ms * kMs, era_end_ms * kMs}, ViewerClock::kMeasured};
  }
};

TEST_F(Window, TakesTheNearerFrameOfTheTwoAroundAnInstant) {
  for (std::uint64_t k = 0; k < 4; ++k) add(k, static_cast<double>(k) * kInterval);
  const FramePair early = window_.show(due(1.3 * kInterval));
  EXPECT_EQ(early.nearer->frame, 1U);
  EXPECT_EQ(early.before->frame, 1U);
  EXPECT_EQ(early.after->frame, 2U);
  EXPECT_DOUBLE_EQ(early.time, 1.3 * kInterval);
  EXPECT_FALSE(early.held);
  EXPECT_EQ(window_.show(due(1.7 * kInterval)).nearer->frame, 2U);
  EXPECT_EQ(gone_, std::vector<std::uint64_t>{0}) << "which nothing needs any more";
  EXPECT_EQ(window_.never_drawn(), 1U);
}

TEST_F(Window, GoesOnForABoundedTimeAndThenHolds) {
  add(0, 1.0);
  EXPECT_DOUBLE_EQ(window_.show(due(1.15)).time, 1.15);
  const FramePair late = window_.show(due(1.5));
  EXPECT_DOUBLE_EQ(late.time, 1.2);
  EXPECT_TRUE(late.held);
  EXPECT_DOUBLE_EQ(bodies_at(late).front().position.x(), 12.0);
  EXPECT_DOUBLE_EQ(window_.show(due(0.5)).time, 0.8) << "as before the first frame";
  add(1, 1.5);
  EXPECT_FALSE(window_.show(due(1.5)).held);
}

TEST_F(Window, WithoutAnInstantTheNewestFrameIsDrawnAsItIs) {
  EXPECT_EQ(window_.show(std::nullopt).nearer, nullptr);
  add(0, 1.0);
  add(1, 2.0);
  const FramePair pair = window_.show(std::nullopt);
  EXPECT_EQ(pair.nearer->frame, 1U);
  EXPECT_DOUBLE_EQ(pair.time, 2.0);
}

TEST_F(Window, StaysInItsEraUntilTheNextOneIsDue) {
  add(10, 5.0, 100);
  add(11, 5.1, 200);
  add(4, 4.9, 300);  // time has gone back: the era begins at 300 ms
  add(5, 5.05, 400);
  const FramePair before = window_.show(due(5.08, -1'000'000, 300));
  EXPECT_EQ(before.before->frame, 10U);
  EXPECT_EQ(before.after->frame, 11U);
  const FramePair after = window_.show(due(4.95, 300));
  EXPECT_EQ(after.before->frame, 4U);
  EXPECT_EQ(after.after->frame, 5U);
  EXPECT_EQ(gone_.size(), 2U) << "frames of the era that has ended";
}

TEST_F(Window, HoldsWhileNoFrameOfTheEraHasCome) {
  add(10, 5.0, 100);
  (void)window_.show(due(5.0));
  const FramePair pair = window_.show(due(1.0, 500));
  ASSERT_NE(pair.nearer, nullptr);
  EXPECT_EQ(pair.nearer->frame, 10U);
  EXPECT_DOUBLE_EQ(pair.time, 5.0);
  EXPECT_TRUE(pair.held);
}

TEST_F(Window, AnotherServerReplacesAllFrames) {
  add(10, 5.0);
  add(11, 5.1);
  add(0, 0.0, 0, 2);
  EXPECT_EQ(gone_.size(), 2U);
  EXPECT_EQ(window_.show(due(0.0)).nearer->source, 2U);
}

TEST_F(Window, KeepsABoundedNumberOfFrames) {
  for (std::uint64_t k = 0; k < 100; ++k) add(k, static_cast<double>(k));
  EXPECT_EQ(gone_.size(), 100 - FrameWindow::kMostFrames);
}

TEST_F(Window, FramesOfOneTimeAndOfWrongOrderAreSorted) {
  add(0, 1.0);
  add(2, 1.2);
  add(1, 1.1);
  add(3, 1.1);  // made again
  const FramePair pair = window_.show(due(1.15));
  EXPECT_EQ(pair.before->frame, 3U);
  EXPECT_EQ(pair.after->frame, 2U);
}

TEST_F(Window, BodiesLieBetweenBothFrames) {
  add(0, 1.0);
  add(1, 1.1);
  const BodyState body = bodies_at(window_.show(due(1.025))).front();
  EXPECT_NEAR(body.position.x(), 10.25, 1e-9);
  EXPECT_NEAR(Eigen::AngleAxisd(body.orientation).angle(), 0.5 * 1.025, 1e-9);
}

TEST_F(Window, ABodyThatIsPutElsewhereIsNotDrawnOnTheWay) {
  add(0, 1.0);
  auto frame = std::make_unique<OceanFrame>();
  frame->source = 1;
  frame->simulation_time = 1.1;
  frame->completed_ns = 0;
  BodyState elsewhere, fresh;
  elsewhere.body = 1;
  elsewhere.position = {500.0, 0.0, 0.0};
  fresh.body = 2;
  frame->bodies = {elsewhere, fresh};
  window_.add(std::move(frame));
  const auto early = bodies_at(window_.show(due(1.02)));
  ASSERT_EQ(early.size(), 1U);
  EXPECT_NEAR(early[0].position.x(), 10.2, 1e-9);
  const auto late = bodies_at(window_.show(due(1.08)));
  ASSERT_EQ(late.size(), 2U) << "a body comes with the frame that has it";
  EXPECT_NEAR(late[0].position.x(), 500.0, 1e-9);
}

/// Water of a steep wave, and drops in flight, at a time: what particles do between frames. Each frame is sorted anew.
std::vector<SurfaceParticle> moving_water(double time, bool turned) {
  constexpr double kAmplitude = 2.0, kLength = 60.0, kGravity = 9.81;
  const double k = 2.0 * std::numbers::pi / kLength, omega = std::sqrt(kGravity * k);
  std::vector<SurfaceParticle> particles;
  for (int i = 0; i < 400; ++i) {
    SurfaceParticle particle;
    const double a = 0.5 * (i % 20), b = 0.5 * (i / 20), phase = k * a - omega * time;
    if (i % 10 != 0) {  // Gerstner's wave
      particle.position =
          Eigen::Vector3d(a - kAmplitude * std::sin(phase), b, kAmplitude * std::cos(phase)).cast<float>();
      particle.velocity = (kAmplitude * omega * Eigen::Vector3d(std::cos(phase), 0.0, std::sin(phase))).cast<float>();
    } else {
      const double t = time - 0.3;
      particle.position = Eigen::Vector3d(a + 3.0 * t, b, 4.0 * t - 0.5 * kGravity * t * t).cast<float>();
      particle.velocity = Eigen::Vector3d(3.0, 0.0, 4.0 - kGravity * t).cast<float>();
    }
    particle.semi_axes.setConstant(0.25F);
    particles.push_back(particle);
  }
  if (turned) std::reverse(particles.begin(), particles.end());
  return particles;
}

/// As a viewer gets them.
std::vector<SurfaceParticle> packed(const std::vector<SurfaceParticle>& particles) {
  std::vector<std::uint8_t> records;
  std::vector<SurfaceParticle> result;
  const PackReport report = pack_particles(particles, 0.5F, records);
  EXPECT_TRUE(unpack_particles(records, report.scales, result));
  return result;
}

TEST(Interpolation, FromTheNearerFrameByVelocityIsMillimetresOff) {
  double worst = 0.0, worst_of_extrapolation = 0.0, worst_of_line = 0.0;
  for (double part = 0.05; part < 1.0; part += 0.1) {
    const double begin = 0.4, time = begin + part * kInterval;
    const auto before = packed(moving_water(begin, false)), after = packed(moving_water(begin + kInterval, true));
    const auto truth = moving_water(time, false);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const SurfaceParticle &from = before[i], &to = after[truth.size() - 1 - i];
      const bool first = part <= 0.5;
      const SurfaceParticle& nearer = first ? from : to;
      const double ahead = first ? part * kInterval : (part - 1.0) * kInterval;
      const auto off = [&](const Eigen::Vector3f& place) {
        return static_cast<double>((place - truth[i].position).norm());
      };
      worst = std::max(worst, off(nearer.position + static_cast<float>(ahead) * nearer.velocity));
      worst_of_line =
          std::max(worst_of_line, off(from.position + static_cast<float>(part) * (to.position - from.position)));
      const float old = static_cast<float>(part * kInterval + 0.05);  // a frame that is 50 ms old already
      const auto earlier = packed(moving_water(begin - 0.05, false));
      worst_of_extrapolation = std::max(worst_of_extrapolation, off(earlier[i].position + old * earlier[i].velocity));
    }
  }
  RecordProperty("worst_mm", std::to_string(1e3 * worst));
  RecordProperty("worst_of_line_mm", std::to_string(1e3 * worst_of_line));
  RecordProperty("worst_of_extrapolation_mm", std::to_string(1e3 * worst_of_extrapolation));
  std::printf("worst: nearer frame %.2f mm, line between both %.2f mm, extrapolation from a frame 50 ms old %.2f mm\n",
              1e3 * worst, 1e3 * worst_of_line, 1e3 * worst_of_extrapolation);
  // Free fall over half an interval, 9.81 / 2 * (1/60)^2 = 1.4 mm, and the packing of places and velocities.
  EXPECT_LT(worst, 2e-3);
}

}  // namespace
}  // namespace pelagos
