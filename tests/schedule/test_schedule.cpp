#include "schedule/schedule.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pelagos {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

SchedulePiece piece(std::int64_t clock_ns, double time, double rate, double limit, std::uint64_t era = 1) {
  return {era, clock_ns, 0, time, rate, limit};
}

TEST(Schedule, GoesAlongALineUpToItsLimit) {
  Schedule schedule;
  EXPECT_FALSE(schedule.at(0));
  schedule.add(piece(10 * kSecond, 5.0, 0.5, 5.8));
  EXPECT_DOUBLE_EQ(schedule.at(11 * kSecond)->time, 5.5);
  EXPECT_DOUBLE_EQ(schedule.at(20 * kSecond)->time, 5.8);
  EXPECT_DOUBLE_EQ(schedule.at(9 * kSecond)->time, 5.0) << "before the first piece";
}

TEST(Schedule, KeepsWhatHeldBeforeAPiece) {
  Schedule schedule;
  schedule.add(piece(0, 0.0, 1.0, 100.0));
  schedule.add(piece(2 * kSecond, 2.0, 0.0, 2.0));  // a pause
  schedule.add(piece(5 * kSecond, 2.0, 1.0, 100.0));
  EXPECT_DOUBLE_EQ(schedule.at(kSecond)->time, 1.0);
  EXPECT_DOUBLE_EQ(schedule.at(4 * kSecond)->time, 2.0);
  EXPECT_DOUBLE_EQ(schedule.at(6 * kSecond)->time, 3.0);
}

TEST(Schedule, ReplacesWhatWasKnownFromAPieceOn) {
  Schedule schedule;
  schedule.add(piece(0, 0.0, 1.0, 100.0));
  schedule.add(piece(kSecond, 1.0, 1.0, 100.0));
  schedule.add(piece(kSecond, 1.0, 1.0, 1.25));  // it turned out to stop there
  EXPECT_DOUBLE_EQ(schedule.at(3 * kSecond)->time, 1.25);
  EXPECT_DOUBLE_EQ(schedule.at(kSecond / 2)->time, 0.5);
}

TEST(Schedule, TellsErasApart) {
  Schedule schedule;
  schedule.add(piece(0, 50.0, 1.0, 100.0, 1));
  schedule.add(piece(kSecond, 51.0, 1.0, 100.0, 1));
  schedule.add(piece(2 * kSecond, 7.0, 1.0, 100.0, 2));  // back
  schedule.add(piece(3 * kSecond, 8.0, 1.0, 100.0, 2));
  const auto before = schedule.at(2 * kSecond - 1).value(), after = schedule.at(4 * kSecond).value();
  EXPECT_NEAR(before.time, 52.0, 1e-6);
  EXPECT_EQ(before.era_begin_ns, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(before.era_end_ns, 2 * kSecond);
  EXPECT_DOUBLE_EQ(after.time, 9.0);
  EXPECT_EQ(after.era_begin_ns, 2 * kSecond);
  EXPECT_EQ(after.era_end_ns, std::numeric_limits<std::int64_t>::max());
}

TEST(Schedule, SurvivesExtremeMomentsAndForgetsOldPieces) {
  Schedule schedule;
  constexpr std::int64_t kMost = 4 * kSecond * kSecond;
  schedule.add(piece(-kMost, 0.0, 1.0, 5.0));
  EXPECT_DOUBLE_EQ(schedule.at(kMost)->time, 5.0);
  for (int i = 0; i < 1000; ++i) schedule.add(piece(i * kSecond, i, 1.0, i + 1.0));
  EXPECT_DOUBLE_EQ(schedule.at(999 * kSecond)->time, 999.0);
  EXPECT_DOUBLE_EQ(schedule.at(0)->time, 1000.0 - Schedule::kMostPieces) << "the oldest piece that is kept";
}

}  // namespace
}  // namespace pelagos
