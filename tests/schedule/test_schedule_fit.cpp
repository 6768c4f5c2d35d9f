#include "schedule/schedule_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace pelagos {
namespace {

constexpr double kInterval = 1.0 / 30.0;  // s

ClockStamp stamp(double seconds) {
  const auto ns = static_cast<std::int64_t>(std::llround(seconds * 1e9));
  return {5'000'000'000'000 + ns, 1'700'000'000'000'000'000 + ns};
}

constexpr double kDelay = 0.1;  // s

/// A fit with what viewers know of it.
struct Course {
  ScheduleFit fit;
  Schedule schedule;
  int pieces = 0;
  struct Shown {
    double clock, time;
  };
  std::vector<Shown> shown;  ///< every 5 ms, by a viewer that is kDelay behind
  double read_until = 0.0;

  void take(const std::optional<SchedulePiece>& piece) {
    if (!piece) return;
    schedule.add(*piece);
    ++pieces;
  }
  void frame(double clock, double time) {
    take(fit.add_frame(stamp(clock), time));
    for (; read_until < clock - kDelay; read_until += 0.005) shown.push_back({read_until, at(read_until)});
  }
  /// `count` frames from `clock` and `time` on, each late by what `late` says (s).
  template <class Late>
  void frames(int count, double clock, double time, double rate, Late late) {
    for (int i = 0; i < count; ++i) frame(clock + i * kInterval / rate + late(i), time + i * kInterval);
  }
  [[nodiscard]] double at(double clock) const { return schedule.at(stamp(clock).clock_ns)->time; }
};

const auto kOnTime = [](int) { return 0.0; };

TEST(ScheduleFit, JitterOfStepsDoesNotMoveThePicture) {
  Course course;
  std::mt19937 random(7);
  std::normal_distribution<double> jitter(0.0, 5e-3);
  double worst = 0.0, slowest = 1e9, fastest = 0.0;
  for (int i = 0; i < 900; ++i) {
    course.frame(i * kInterval + jitter(random), i * kInterval);
    if (i < 90) continue;
    const double clock = i * kInterval - 0.05;  // viewers read it later than it is made
    worst = std::max(worst, std::abs(course.at(clock) - clock));
    const double rate = (course.at(clock) - course.at(clock - 0.01)) / 0.01;
    slowest = std::min(slowest, rate);
    fastest = std::max(fastest, rate);
  }
  // The median of 64 moments is off by 1.25 * 5 ms / sqrt(64) = 0.8 ms, and four of these are enough for 30 s.
  EXPECT_LT(worst, 3.5e-3);
  EXPECT_GT(slowest, 0.99);
  EXPECT_LT(fastest, 1.01);
}

TEST(ScheduleFit, FollowsASlowServer) {
  Course course;
  course.frames(300, 0.0, 0.0, 0.4, kOnTime);
  const double end = 299 * kInterval / 0.4;
  EXPECT_NEAR(course.schedule.newest().rate, 0.4, 2e-3);
  EXPECT_NEAR(course.at(end), 299 * kInterval, 1e-3);
}

TEST(ScheduleFit, FollowsAServerThatDoesNotKeepPace) {
  Course course;
  course.frames(3000, 0.0, 0.0, 40.0, kOnTime);
  EXPECT_NEAR(course.schedule.newest().rate, 40.0, 0.4);
  EXPECT_NEAR(course.at(2999 * kInterval / 40.0), 2999 * kInterval, 0.2) << "5 ms of the clock";
  EXPECT_LT(course.pieces, 2999 / 40.0 * kInterval / 0.02 + 50) << "at most one in 20 ms";
}

TEST(ScheduleFit, FollowsAChangeOfRateWithoutALeap) {
  Course course;
  course.frames(120, 0.0, 0.0, 1.0, kOnTime);
  course.frames(120, 120 * kInterval, 120 * kInterval, 0.5, kOnTime);
  double last = 0.0;
  for (const auto& [clock, time] : course.shown) {
    EXPECT_GE(time, last) << clock;
    EXPECT_LT(time - last, 0.005 * 1.3) << clock;
    last = time;
  }
  EXPECT_NEAR(course.at(11.9), 120 * kInterval + (11.9 - 120 * kInterval) / 2, 0.01);
}

TEST(ScheduleFit, FollowsADriftOfTheClock) {
  Course course;
  course.frames(1800, 0.0, 0.0, 1.0 + 2e-4, kOnTime);
  EXPECT_NEAR(course.at(1799 * kInterval / 1.0002), 1799 * kInterval, 1e-3);
}

TEST(ScheduleFit, LeavesOutliersOut) {
  Course course;
  course.frames(300, 0.0, 0.0, 1.0, [](int i) { return i % 10 == 9 ? 0.03 : 0.0; });
  double worst = 0.0;
  for (const auto& [clock, time] : course.shown)
    if (clock > 3.0) worst = std::max(worst, std::abs(time - clock));
  EXPECT_LT(worst, 2e-3);
}

TEST(ScheduleFit, HoldsWhereAFrameIsLateAndNeverGoesBack) {
  Course course;
  course.frames(90, 0.0, 0.0, 1.0, kOnTime);
  const double last_frame = 89 * kInterval, again = last_frame + 1.2;
  EXPECT_NEAR(course.at(again - 0.01), last_frame + ScheduleFit::kAhead, 1e-3) << "so far and no farther";
  course.frames(150, again, 90 * kInterval, 1.0, kOnTime);
  double last = 0.0;
  for (const auto& [clock, time] : course.shown) {
    EXPECT_GE(time, last) << clock;
    last = time;
  }
  const double end = again + 149 * kInterval;
  EXPECT_NEAR(course.at(end), 239 * kInterval, 5e-3);
}

TEST(ScheduleFit, StopsAtTheLastFrameOfAPause) {
  Course course;
  course.frames(90, 0.0, 0.0, 1.0, kOnTime);
  const double last_frame = 89 * kInterval, paused_at = last_frame + 0.02;
  course.take(course.fit.pause());
  EXPECT_FALSE(course.fit.pause()) << "it has been told";
  EXPECT_NEAR(course.at(paused_at - 0.1), paused_at - 0.1, 1e-3) << "viewers that are behind still move";
  EXPECT_DOUBLE_EQ(course.at(paused_at), last_frame);
  EXPECT_DOUBLE_EQ(course.at(paused_at + 60.0), last_frame);
  course.take(course.fit.resume(stamp(paused_at + 60.0)));
  EXPECT_FALSE(course.fit.resume(stamp(paused_at + 60.0)));
  course.frames(90, paused_at + 60.0 + kInterval, 90 * kInterval, 1.0, kOnTime);
  EXPECT_NEAR(course.at(paused_at + 61.0), last_frame + 1.0, 5e-3);
}

TEST(ScheduleFit, GoesFromFrameToFrameWherePausedStepsAreMade) {
  Course course;
  course.frames(30, 0.0, 0.0, 1.0, kOnTime);
  course.take(course.fit.pause());
  course.frame(10.0, 30 * kInterval);
  EXPECT_DOUBLE_EQ(course.at(11.0), 30 * kInterval);
  course.frame(20.0, 31 * kInterval);
  EXPECT_DOUBLE_EQ(course.at(19.0), 30 * kInterval);
  EXPECT_DOUBLE_EQ(course.at(21.0), 31 * kInterval);
}

TEST(ScheduleFit, BeginsAnEraWhereTimeGoesBack) {
  Course course;
  course.frames(60, 0.0, 0.0, 1.0, kOnTime);
  const std::uint64_t era = course.schedule.newest().era;
  course.frames(60, 60 * kInterval, 0.5, 1.0, kOnTime);
  EXPECT_EQ(course.schedule.newest().era, era + 1);
  EXPECT_NEAR(course.at(60 * kInterval - 0.01), 60 * kInterval - 0.01, 1e-3);
  EXPECT_NEAR(course.at(60 * kInterval + 0.5), 1.0, 1e-3);
  EXPECT_EQ(course.schedule.at(stamp(60 * kInterval + 0.5).clock_ns)->era_begin_ns, stamp(60 * kInterval).clock_ns);
}

TEST(ScheduleFit, LeapsToAFrameFarAhead) {
  Course course;
  course.frames(60, 0.0, 0.0, 1.0, kOnTime);
  course.frames(60, 60 * kInterval, 500.0, 1.0, kOnTime);
  EXPECT_NEAR(course.at(60 * kInterval + 0.5), 500.5, 1e-3);
  EXPECT_EQ(course.schedule.newest().era, 1U) << "frames before and after belong together";
}

TEST(ScheduleFit, TakesTheSameFrameOnce) {
  Course course;
  course.frames(3, 0.0, 0.0, 1.0, kOnTime);
  const int pieces = course.pieces;
  course.frame(5.0, 2 * kInterval);
  EXPECT_EQ(course.pieces, pieces);
}

}  // namespace
}  // namespace pelagos
