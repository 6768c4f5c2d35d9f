// Streams of poses against the gate: honest bridges pass unchanged, contradictory ones cannot throw a hull about.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "rigid/driven_body.hpp"
#include "transport/pose_gate.hpp"

namespace pelagos {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kSender = 5;

/// A ship that turns about at 7 m/s on a circle of 40 m, rolls and heaves; or does nothing of it.
BodyPose ship_at(double time) {
  const double rate = 7.0 / 40.0, heading = rate * time;
  const double roll = 0.3 * std::sin(1.0 * time), roll_rate = 0.3 * std::cos(1.0 * time);
  BodyPose pose;
  pose.body = 1;
  pose.time = time;
  pose.position = {40.0 * std::sin(heading), -40.0 * std::cos(heading), 0.5 * std::sin(1.2 * time)};
  pose.velocity = {7.0 * std::cos(heading), 7.0 * std::sin(heading), 0.6 * std::cos(1.2 * time)};
  const Vector3d forward(std::cos(heading), std::sin(heading), 0.0);
  pose.orientation = Eigen::AngleAxisd(heading, Vector3d::UnitZ()) * Eigen::AngleAxisd(roll, Vector3d::UnitX());
  pose.angular_velocity = rate * Vector3d::UnitZ() + roll_rate * forward;
  return pose;
}

BodyPose still(double time) {
  BodyPose pose;
  pose.body = 1;
  pose.time = time;
  return pose;
}

/// Sends poses at a rate through a gate to a body, which is moved in steps of a frame.
class Stream {
 public:
  explicit Stream(double spacing = 1.0)
      : spacing_(spacing), gate_({1}, limits(spacing)), body_(start(), spacing, 30 * spacing) {}

  /// @param pose of time and number
  void send(double rate, double seconds, const std::function<BodyPose(double, int)>& pose, double begin = 0.0) {
    const int count = static_cast<int>(std::lround(rate * seconds));
    for (int k = 0; k < count; ++k) {
      const double now = begin + k / rate;
      move_to(now);
      BodyPose sent = pose(now, k);
      last_fault_ = gate_.check(
          sent, {kSender},
          epoch_ + std::chrono::duration_cast<PoseGate::Clock::duration>(std::chrono::duration<double>(now)));
      if (last_fault_) continue;
      last_passed_ = sent;
      fastest_passed_ = std::max(fastest_passed_, sent.velocity.norm());
      fastest_turn_passed_ = std::max(fastest_turn_passed_, sent.angular_velocity.norm());
      body_.accept(sent, now);
    }
  }
  /// Lets time pass without poses.
  void move_to(double now) {
    constexpr double kStep = 0.02;
    for (; time_ + kStep <= now; time_ += kStep) {
      const BodyState state = body_.advance(kStep, time_);
      fastest_ = std::max(fastest_, state.velocity.norm() + 30 * spacing_ * state.angular_velocity.norm());
      farthest_ = std::max(farthest_, state.position.norm());
    }
  }
  std::uint64_t refused(PoseFault fault) const { return gate_.counters().refused[static_cast<std::size_t>(fault)]; }
  const PoseCounters& counters() const { return gate_.counters(); }

  double fastest_ = 0.0, farthest_ = 0.0, fastest_passed_ = 0.0, fastest_turn_passed_ = 0.0;
  BodyPose last_passed_;
  std::optional<PoseFault> last_fault_;
  double spacing_;

 private:
  static PoseLimits limits(double spacing) {
    PoseLimits limits;
    limits.spacing = spacing;
    return limits;
  }
  static BodyState start() {
    BodyState state;
    state.body = 1;
    return state;
  }
  PoseGate gate_;

 public:
  DrivenBody body_;

 private:
  double time_ = 0.0;
  PoseGate::Clock::time_point epoch_ = PoseGate::Clock::now();
};

/// A step of 0.07 sqrt(d / g), the scenes' usual one, allows 0.4 spacings: what a hull may do without slower steps.
double free_speed(double spacing) { return 0.4 / 0.07 * std::sqrt(9.81 * spacing); }

struct Rate {
  double hertz;
};
class HonestBridges : public testing::TestWithParam<double> {};

TEST_P(HonestBridges, PassWithTheirOwnVelocities) {
  Stream stream;
  stream.send(GetParam(), 20.0, [](double t, int) { return ship_at(t); });
  EXPECT_EQ(stream.counters().refused_in_all(), 0U);
  EXPECT_EQ(stream.counters().corrected, 0U);
  const BodyPose sent = ship_at(stream.last_passed_.time);
  EXPECT_TRUE(stream.last_passed_.velocity.isApprox(sent.velocity, 1e-9));
  EXPECT_TRUE(stream.last_passed_.angular_velocity.isApprox(sent.angular_velocity, 1e-9));
}

TEST_P(HonestBridges, PassWithJitteredTimesAndNoise) {
  std::mt19937 random(3);
  std::normal_distribution<double> one;
  const double jitter = std::min(0.004, 0.2 / GetParam());
  Stream stream;
  stream.send(GetParam(), 30.0, [&](double t, int) {
    BodyPose pose = ship_at(t);
    pose.time += jitter * std::clamp(one(random), -2.0, 2.0);
    pose.position += 0.05 * Vector3d(one(random), one(random), one(random));
    pose.velocity += 0.2 * Vector3d(one(random), one(random), one(random));
    pose.angular_velocity += 0.01 * Vector3d(one(random), one(random), one(random));
    pose.orientation = Eigen::AngleAxisd(0.003 * one(random), Vector3d::UnitY()) * pose.orientation;
    return pose;
  });
  EXPECT_EQ(stream.counters().refused_in_all(), 0U);
  EXPECT_EQ(stream.counters().corrected, 0U);
}

TEST_P(HonestBridges, PassWithCoarsePlaces) {
  Stream stream;
  stream.send(GetParam(), 20.0, [](double t, int) {
    BodyPose pose = ship_at(t);
    pose.position = (pose.position * 4.0).array().round() / 4.0;  // to a quarter of a metre
    return pose;
  });
  EXPECT_EQ(stream.counters().refused_in_all(), 0U);
  EXPECT_EQ(stream.counters().corrected, 0U);
}

TEST_P(HonestBridges, ThatKnowNoVelocitiesGetThoseOfTheirPlaces) {
  Stream stream;
  stream.send(GetParam(), 20.0, [](double t, int) {
    BodyPose pose = ship_at(t);
    pose.velocity.setZero();
    pose.angular_velocity.setZero();
    return pose;
  });
  EXPECT_EQ(stream.counters().refused_in_all(), 0U);
  EXPECT_EQ(stream.counters().corrected, 0U);
  const BodyPose told = ship_at(stream.last_passed_.time);
  const double lag = std::max(0.25, 1.0 / GetParam());  // half the window; the ship turns meanwhile
  EXPECT_LT((stream.last_passed_.velocity - told.velocity).norm(), 0.3 + 7.0 * 7.0 / 40.0 * lag);
  if (GetParam() < 5.0) return;  // once a second is too rare to follow its roll
  EXPECT_EQ(stream.body_.jumps(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Rates, HonestBridges, testing::Values(1.0, 5.0, 10.0, 30.0, 60.0, 100.0));

class ContradictoryVelocities : public testing::TestWithParam<double> {};

/// The parameter is the wave's frequency; 30 Hz at 60 poses a second changes the sign at each of them.
TEST_P(ContradictoryVelocities, DoNotMoveABodyThatStaysInPlace) {
  for (const double spacing : {1.0, 0.05}) {
    Stream stream(spacing);
    stream.send(60.0, 10.0, [](double t, int) {
      BodyPose pose = still(t);
      pose.velocity = {std::cos(2.0 * EIGEN_PI * GetParam() * t) >= 0.0 ? 199.0 : -199.0, 0.0, 0.0};
      return pose;
    });
    stream.move_to(20.0);  // and nothing is left that carries it off when the poses end
    EXPECT_LT(stream.fastest_, free_speed(spacing)) << spacing;
    EXPECT_LT(stream.farthest_, 5.0 * spacing) << spacing;
    EXPECT_GT(stream.counters().corrected, 100U);
    EXPECT_EQ(stream.counters().refused_in_all(), 0U);
  }
}

TEST_P(ContradictoryVelocities, DoNotTurnABodyThatStaysInPlace) {
  Stream stream;
  stream.send(60.0, 10.0, [](double t, int) {
    BodyPose pose = still(t);
    pose.angular_velocity = {0.0, 0.0, std::cos(2.0 * EIGEN_PI * GetParam() * t) >= 0.0 ? 19.0 : -19.0};
    return pose;
  });
  stream.move_to(20.0);
  EXPECT_LT(stream.fastest_, free_speed(1.0));
  EXPECT_GT(stream.counters().corrected, 100U);
}

INSTANTIATE_TEST_SUITE_P(Frequencies, ContradictoryVelocities, testing::Values(0.0, 0.5, 1.0, 2.0, 7.0, 30.0));

TEST(Poses, OneOfThemAloneCarriesNobodyOff) {
  Stream stream;
  stream.send(1.0, 1.0, [](double t, int) {
    BodyPose pose = still(t);
    pose.velocity = {150.0, 0.0, 0.0};
    pose.angular_velocity = {15.0, 0.0, 0.0};
    return pose;
  });
  stream.move_to(10.0);
  EXPECT_LT(stream.farthest_, 5.0);
}

TEST(Poses, ThatLeapToAndFroLeaveTheBodyAtTheFirstPlace) {
  for (const double rate : {10.0, 60.0, 1000.0}) {
    Stream stream;
    stream.send(rate, 6.0, [](double t, int k) {
      BodyPose pose = still(t);
      if (k % 2 == 1) pose.position = {15.0, -9.0, 0.0};
      return pose;
    });
    EXPECT_LE(stream.body_.jumps(), 1U) << rate;  // the first pose puts it where the bridge is
    EXPECT_LT(stream.farthest_, 5.0) << rate;
    EXPECT_GT(stream.refused(PoseFault::kLeaps), 10U) << rate;
  }
}

TEST(Poses, ThatTurnToAndFroLeaveTheBodyAsItWas) {
  for (const double angle : {0.25, 1.0, 3.1}) {
    Stream stream;
    stream.send(60.0, 6.0, [&](double t, int k) {
      BodyPose pose = still(t);
      if (k % 2 == 1) pose.orientation = Eigen::AngleAxisd(angle, Vector3d(0.6, 0.0, 0.8));
      return pose;
    });
    EXPECT_LE(stream.body_.jumps(), 1U) << angle;
    EXPECT_GT(stream.refused(PoseFault::kLeaps), 10U) << angle;
    EXPECT_LT(stream.fastest_, free_speed(1.0)) << angle;
  }
}

TEST(Poses, ThatShakeABodyWithinALeapDoNotTearItAbout) {
  for (const int run : {1, 3, 8, 30}) {
    Stream stream;
    stream.send(60.0, 10.0, [&](double t, int k) {
      BodyPose pose = still(t);
      pose.position = {(k / run) % 2 == 0 ? 1.2 : -1.2, 0.0, 0.0};
      pose.orientation = Eigen::AngleAxisd((k / run) % 2 == 0 ? 0.04 : -0.04, Vector3d::UnitX());
      return pose;
    });
    EXPECT_LE(stream.body_.jumps(), 1U) << run;
    EXPECT_LT(stream.fastest_, 1.25 * free_speed(1.0)) << run;  // steps are hardly shorter
  }
}

TEST(Poses, ThatLeapInPairsOrAtRandomMoveTheBodyOnceInFiveSeconds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-18.0, 18.0);
  for (const int run : {1, 2, 3, 40}) {
    Stream stream;
    Vector3d there = Vector3d::Zero();
    stream.send(60.0, 20.0, [&](double t, int k) {
      if (k % run == 0) there = {place(random), place(random), 0.0};
      BodyPose pose = still(t);
      pose.position = there;
      return pose;
    });
    EXPECT_LE(stream.body_.jumps(), 1U + 2U + 4U + 2U) << run;  // to the first place, two saved up, one each 5 s, or so
    EXPECT_LT(stream.fastest_, 2.0 * free_speed(1.0)) << run;
  }
}

TEST(Poses, OfARareLeaperMoveTheBodyOnceInFiveSeconds) {
  Stream stream;
  stream.send(1.9, 20.0, [](double t, int k) {  // so rarely that each comes after a silence
    BodyPose pose = still(t);
    if (k % 2 == 1) pose.position = {30.0, 0.0, 0.0};
    return pose;
  });
  EXPECT_LE(stream.body_.jumps(), 1U + 2U + 4U);
}

TEST(Poses, OfAResetAreTakenWithTheSecond) {
  Stream stream;
  stream.send(60.0, 3.0, [](double t, int) { return ship_at(t); });
  ASSERT_EQ(stream.counters().refused_in_all(), 0U);
  const auto moved = [](double t, int) {
    BodyPose pose = ship_at(t);
    pose.position += Vector3d(300.0, 200.0, 0.0);
    return pose;
  };
  stream.send(60.0, 1.0 / 60.0, moved, 3.0);
  EXPECT_EQ(stream.last_fault_, PoseFault::kLeaps);
  stream.send(60.0, 3.0, moved, 3.0 + 1.0 / 60.0);
  EXPECT_EQ(stream.counters().refused_in_all(), 1U);
  EXPECT_EQ(stream.counters().corrected, 0U);
  EXPECT_NEAR((stream.last_passed_.velocity - ship_at(stream.last_passed_.time).velocity).norm(), 0.0, 1e-9);
}

TEST(Poses, AfterASilencePutTheBodyAnywhereAtOnce) {
  Stream stream;
  stream.send(60.0, 1.0, [](double t, int) { return ship_at(t); });
  stream.send(
      60.0, 0.1,
      [](double t, int) {
        BodyPose pose = still(t - 2.0);  // restarted: its clock is behind
        pose.position = {-200.0, 50.0, 0.0};
        return pose;
      },
      2.0);
  EXPECT_EQ(stream.counters().refused_in_all(), 0U);
}

TEST(Poses, InOtherUnitsAreTold) {
  Stream stream;
  stream.send(60.0, 5.0, [](double t, int) {
    BodyPose pose = ship_at(t);
    pose.velocity /= 0.514444;  // knots
    return pose;
  });
  EXPECT_GT(stream.counters().corrected, 100U);
  EXPECT_NEAR(stream.last_passed_.velocity.norm(), 7.0, 0.6);
}

TEST(Poses, WithTimesThatDoNotPassAreHarmless) {
  for (const double factor : {1e-9, 1e-3, 60.0, 1e5, 1e150, 1e307}) {
    Stream stream;
    stream.send(60.0, 10.0, [&](double t, int k) {
      BodyPose pose = still(1.0 + factor * t);
      pose.velocity = {k % 2 == 0 ? 199.0 : -199.0, 0.0, 0.0};
      return pose;
    });
    stream.move_to(20.0);
    EXPECT_LT(stream.fastest_, free_speed(1.0)) << factor;
    EXPECT_LT(stream.farthest_, 5.0) << factor;
  }
}

TEST(Poses, OfAFloodAreHarmlessToo) {
  Stream stream;
  stream.send(10000.0, 2.0, [](double t, int k) {
    BodyPose pose = still(t);
    pose.position = {0.2 * (k % 3), 0.0, 0.0};
    pose.velocity = {k % 2 == 0 ? 199.0 : -199.0, 0.0, 0.0};
    pose.angular_velocity = {0.0, k % 2 == 0 ? 19.0 : -19.0, 0.0};
    return pose;
  });
  stream.move_to(20.0);
  EXPECT_LT(stream.fastest_, free_speed(1.0));
  EXPECT_LT(stream.farthest_, 5.0);
  EXPECT_GT(stream.counters().corrected, 1000U);
}

}  // namespace
}  // namespace pelagos
