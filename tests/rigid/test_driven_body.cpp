#include <gtest/gtest.h>

#include <cmath>

#include "rigid/driven_body.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr double kStep = 0.02, kSpacing = 1.0, kReach = 20.0;

BodyPose straight_course(double sent, const Eigen::Vector3d& velocity) {
  BodyPose pose;
  pose.body = 1;
  pose.time = sent;
  pose.position = velocity * sent;
  pose.velocity = velocity;
  return pose;
}

DrivenBody make_body() {
  BodyState start;
  start.body = 1;
  return DrivenBody(start, kSpacing, kReach);
}

TEST(DrivenBody, HoldsItsPlaceUntilAPoseArrives) {
  DrivenBody body = make_body();
  const BodyState state = body.advance(kStep, 5.0);
  EXPECT_EQ(state.health, PoseHealth::kNone);
  EXPECT_LT(state.pose_age, 0.0);
  EXPECT_EQ(state.position, Eigen::Vector3d::Zero());
  EXPECT_EQ(state.velocity, Eigen::Vector3d::Zero());
}

TEST(DrivenBody, FollowsASteadyCourseWithoutLag) {
  DrivenBody body = make_body();
  const Eigen::Vector3d velocity(8, 2, 0);
  double next_pose = 0.0;
  for (int n = 0; n < 500; ++n) {
    const double now = n * kStep;
    while (next_pose <= now + 1e-9) {
      body.accept(straight_course(next_pose + 1000.0, velocity), next_pose);  // the sender's clock is 1000 s ahead
      next_pose += 1.0 / 30;
    }
    const BodyState state = body.advance(kStep, now);
    EXPECT_EQ(state.health, PoseHealth::kFresh);
    if (n > 5) {
      // poses agree with the reckoning exactly; what is left is rounding
      EXPECT_LT((state.position - velocity * (1000.0 + now + kStep)).norm(), 1e-6);
      EXPECT_LT((state.velocity - velocity).norm(), 1e-6);
    }
  }
  EXPECT_EQ(body.jumps(), 1u);  // from the scene's place to the first pose
}

TEST(DrivenBody, TakesOutAnErrorCriticallyDamped) {
  DrivenBody body = make_body();
  BodyPose pose = straight_course(0, {0, 0, 0});
  pose.position = {2, 0, 0};  // below the jump distance of 5 m
  double before = 0.0;
  for (int n = 0; n < 100; ++n) {
    pose.time = n * kStep;
    body.accept(pose, n * kStep);
    const double x = body.advance(kStep, n * kStep).position.x();
    EXPECT_GE(x, before);  // never back
    EXPECT_LE(x, 2.0);     // never beyond
    before = x;
    // the closed form 2 - 2 (1 + w t) exp(-w t), whatever the step
    const double wt = 6.0 * (n + 1) * kStep;
    EXPECT_NEAR(x, 2.0 - 2.0 * (1.0 + wt) * std::exp(-wt), 1e-9);
  }
  EXPECT_EQ(body.jumps(), 0u);
}

TEST(DrivenBody, VelocityIsTheRateOfThePose) {
  DrivenBody body = make_body();
  BodyPose pose = straight_course(0, {1, 0.5, 0});
  pose.position = {1, 1, 0.2};
  pose.orientation = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ());
  pose.angular_velocity = {0, 0, 0.05};
  body.accept(pose, 0);
  const double dt = 1e-4;
  BodyState before = body.advance(dt, 0);
  for (int n = 1; n < 2000; ++n) {
    const BodyState after = body.advance(dt, n * dt);
    const Eigen::AngleAxisd turn(after.orientation * before.orientation.conjugate());
    // differences of first order in the step: accelerations are below 40 m/s^2
    EXPECT_LT(((after.position - before.position) / dt - after.velocity).norm(), 5e-3);
    EXPECT_LT((turn.angle() * turn.axis() / dt - after.angular_velocity).norm(), 5e-3);
    before = after;
  }
}

TEST(DrivenBody, JitterOfTheNetworkDoesNotShakeTheHull) {
  DrivenBody body = make_body();
  SplitMix64 random(2);
  const Eigen::Vector3d velocity(8, 0, 0);
  double sent = 0.0, arrives = 0.0, worst_speed = 0.0, worst_lag = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const double now = n * kStep;
    while (arrives <= now) {
      body.accept(straight_course(sent, velocity), now);
      sent += 1.0 / 30;
      arrives = std::max(arrives, sent + 0.08 * random.next_unit());  // up to 80 ms late, in order
    }
    const BodyState state = body.advance(kStep, now);
    if (n < 100) continue;
    worst_speed = std::max(worst_speed, (state.velocity - velocity).norm());
    worst_lag = std::max(worst_lag, (state.position - velocity * (now + kStep)).norm());
  }
  // Jumping to each pose would show 8 m/s * 80 ms / 20 ms = 32 m/s. The clock filter leaves a few per cent.
  EXPECT_LT(worst_speed, 0.5);
  EXPECT_LT(worst_lag, 8.0 * 0.08);  // within the delay itself
}

TEST(DrivenBody, CoastsThenComesToRest) {
  DrivenBody body = make_body();
  body.accept(straight_course(0, {5, 0, 0}), 0);
  BodyState state;
  double before = 5.0;
  for (int n = 0; n < 1000; ++n) {
    const double now = n * kStep;
    state = body.advance(kStep, now);
    const double age = now + kStep;
    const PoseHealth expected = age < 0.5   ? PoseHealth::kFresh
                                : age < 3.0 ? PoseHealth::kCoasting
                                            : PoseHealth::kHolding;
    EXPECT_EQ(state.health, expected) << age;
    EXPECT_NEAR(state.pose_age, age, 1e-12);
    if (age > 2.0 && age < 3.0) {
      EXPECT_NEAR(state.velocity.x(), 5.0, 1e-3);  // left of the start from rest: 5 w t exp(-w t) at w t = 12
    }
    if (age >= 3.0) {
      EXPECT_LE(state.velocity.x(), before + 1e-9);                // smoothly down,
      EXPECT_GE(state.velocity.x(), before - 5.0 * kStep - 1e-3);  // at no more than v / stopping time
    }
    before = state.velocity.x();
  }
  EXPECT_LT(state.velocity.norm(), 1e-4);
  EXPECT_NEAR(state.position.x(), 5 * 3 + 5 * 1, 1e-3);  // three seconds at full speed, then v times 1 s

  body.accept(straight_course(30, {5, 0, 0}), 20.0);  // the stream comes back 130 m farther on
  state = body.advance(kStep, 20.0);
  EXPECT_EQ(state.health, PoseHealth::kFresh);
  EXPECT_NEAR(state.position.x(), 150 + 5 * kStep, 1e-9);
}

TEST(DrivenBody, RollRateFadesWhileCoasting) {
  DrivenBody body = make_body();
  BodyPose pose = straight_course(0, {0, 0, 0});
  pose.angular_velocity = {0.2, 0, 0.1};
  body.accept(pose, 0);
  BodyState state;
  for (int n = 0; n < 150; ++n) state = body.advance(kStep, n * kStep);
  const Eigen::Vector3d up = state.orientation * Eigen::Vector3d::UnitZ();
  EXPECT_LT(std::acos(up.z()), 0.2 * 1.01);            // 0.5 s at full rate and 0.5 s of fading; 3 s would be 0.6 rad
  EXPECT_NEAR(state.angular_velocity.z(), 0.1, 1e-3);  // a turn goes on
}

TEST(DrivenBody, TeleportsJumpAndShowACappedVelocity) {
  DrivenBody body = make_body();
  body.accept(straight_course(0, {0, 0, 0}), 0);
  body.advance(kStep, 0);
  BodyPose far = straight_course(0.1, {100, 0, 0});
  far.position = {500, 0, 0};
  far.angular_velocity = {0, 0, 1};
  body.accept(far, 0.1);
  const BodyState state = body.advance(kStep, 0.1);
  EXPECT_EQ(body.jumps(), 1u);
  EXPECT_NEAR(state.position.x(), 502.0, 1e-9);
  EXPECT_LE(state.velocity.norm() + kReach * state.angular_velocity.norm(), 0.4 * kSpacing / kStep + 1e-9);

  // a turn of 90 degrees moves the farthest sample by more than the jump distance
  BodyPose turned = far;
  turned.time = 0.2;
  turned.position = {512, 0, 0};
  turned.orientation = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ());
  body.accept(turned, 0.2);
  body.advance(kStep, 0.2);
  EXPECT_EQ(body.jumps(), 2u);
}

TEST(DrivenBody, IgnoresOldSamplesAndBelievesARestartedSender) {
  DrivenBody body = make_body();
  EXPECT_TRUE(body.accept(straight_course(100.0, {1, 0, 0}), 10.0));
  EXPECT_FALSE(body.accept(straight_course(99.9, {1, 0, 0}), 10.1));
  EXPECT_FALSE(body.accept(straight_course(100.0, {1, 0, 0}), 10.1));
  EXPECT_TRUE(body.accept(straight_course(0.0, {50, 0, 0}), 10.2));
  for (int n = 0; n < 50; ++n) body.advance(kStep, 10.2 + n * kStep);
  // on the restarted course, 1 s after its start; half a hundredth of the velocity step is left after w t = 6
  EXPECT_NEAR(body.state().position.x(), 50.0, 0.3);
}

TEST(DrivenBody, StaysStableForAnyStep) {
  for (const double dt : {1e-6, 0.1, 10.0}) {
    DrivenBody body = make_body();
    BodyPose pose = straight_course(0, {1, 0, 0});
    pose.position = {4, 0, 0};
    body.accept(pose, 0);
    for (int n = 0; n < 50; ++n) {
      const BodyState state = body.advance(dt, n * dt);
      ASSERT_TRUE(state.position.allFinite());
      ASSERT_LT(state.position.norm(), 20.0);
      ASSERT_NEAR(state.orientation.norm(), 1.0, 1e-9);
    }
    EXPECT_EQ(body.advance(0.0, 50 * dt).position, body.state().position);  // paused: no time, no motion
  }
}

}  // namespace
}  // namespace pelagos
