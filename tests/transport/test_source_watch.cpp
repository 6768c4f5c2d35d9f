#include <gtest/gtest.h>

#include <limits>

#include "client/frame_count.hpp"
#include "client/listening_time.hpp"
#include "client/source_watch.hpp"

namespace pelagos {
namespace {

using namespace std::chrono_literals;

class Watch : public testing::Test {
 protected:
  Standing hear(std::uint64_t source, std::uint8_t process, double seconds, bool valid = true) {
    return watch_.hear(
        {source, {process}}, valid,
        start_ + std::chrono::duration_cast<SourceWatch::Clock::duration>(std::chrono::duration<double>(seconds)));
  }

  SourceWatch::Clock::time_point start_ = SourceWatch::Clock::now();
  bool present_ = true;
  int asked_ = 0;
  SourceWatch watch_{[this](const ParticipantId&) { return ++asked_, present_; }};
};

TEST_F(Watch, FollowsTheFirstAndAnotherOnceThatIsSilent) {
  EXPECT_EQ(hear(7, 1, 0.0), Standing::kTakenOver);
  EXPECT_EQ(hear(7, 1, 1.0), Standing::kFollowed);
  EXPECT_EQ(hear(8, 2, 2.9), Standing::kOther);
  EXPECT_EQ(hear(8, 2, 3.0), Standing::kTakenOver);
  EXPECT_EQ(hear(7, 1, 3.1), Standing::kOther);
  EXPECT_EQ(asked_, 0) << "another source is another server: nobody need have left";
}

TEST_F(Watch, AnySampleAfterABreakOfAnyLengthIsASignOfLife) {
  EXPECT_FALSE(watch_.last_heard());
  (void)hear(7, 1, 0.0);
  double now = 0.0;
  for (const double silence : {1.5, 3.0, 9.0, 12.0, 4000.0}) {
    now += silence;
    EXPECT_EQ(hear(7, 1, now), Standing::kFollowed);
    EXPECT_EQ(watch_.last_heard(), start_ + std::chrono::milliseconds(static_cast<int>(now * 1e3)));
  }
}

TEST_F(Watch, ASourceBelongsToTheProcessThatUsedItFirst) {
  (void)hear(7, 1, 0.0);
  EXPECT_EQ(hear(7, 2, 0.1), Standing::kIntruder);
  EXPECT_EQ(watch_.last_heard(), start_) << "an intruder is no sign of life";
  EXPECT_EQ(hear(7, 2, 5.0), Standing::kIntruder) << "silent, but still in the domain";
  EXPECT_EQ(hear(7, 1, 6.0), Standing::kFollowed);
  present_ = false;
  EXPECT_EQ(hear(7, 2, 7.0), Standing::kIntruder) << "it was heard a second ago";
  EXPECT_EQ(hear(7, 2, 8.5), Standing::kTakenOver);
  EXPECT_EQ(hear(7, 1, 8.6), Standing::kIntruder);
}

TEST_F(Watch, AFloodOfAnIntruderAsksSeldom) {
  (void)hear(7, 1, 0.0);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(hear(7, 2, 3.0 + 0.001 * i), Standing::kIntruder);
  EXPECT_LE(asked_, 5);
}

TEST_F(Watch, NobodyIsFollowedForAFaultySample) {
  EXPECT_EQ(hear(7, 1, 0.0, false), Standing::kNobody);
  EXPECT_FALSE(watch_.last_heard());
  (void)hear(7, 1, 1.0);
  EXPECT_EQ(hear(7, 1, 5.0, false), Standing::kFollowed) << "it lives all the same";
  EXPECT_EQ(hear(8, 2, 9.0, false), Standing::kNobody);
}

TEST(FrameCount, CountsWhatIsMissing) {
  FrameCount count;
  EXPECT_EQ(count.count(100, 1), FrameOrder::kNext);
  EXPECT_EQ(count.count(101, 2), FrameOrder::kNext);
  EXPECT_EQ(count.count(105, 3), FrameOrder::kNext);
  EXPECT_EQ(count.missed(), 3U);
  EXPECT_EQ(count.count(105, 3), FrameOrder::kRepeated);
  EXPECT_EQ(count.count(106, 4), FrameOrder::kNext);
  EXPECT_EQ(count.missed(), 3U);
  EXPECT_EQ(count.jumps(), 0U);
}

TEST(FrameCount, NoNumbersMakeItWrap) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
  FrameCount count;
  for (const std::uint64_t frame :
       {std::uint64_t{10}, kLargest, std::uint64_t{0}, kLargest - 3, kLargest, std::uint64_t{5}})
    (void)count.count(frame, 0);
  EXPECT_EQ(count.missed(), 2U) << "the two between the last ones of the largest";
  EXPECT_EQ(count.jumps(), 4U);
}

TEST(FrameCount, AFrameMadeAgainIsAJumpNoRepetition) {
  FrameCount count;
  (void)count.count(10, 1);
  EXPECT_EQ(count.count(10, 2), FrameOrder::kJump);
  EXPECT_EQ(count.count(9, 3), FrameOrder::kJump);
  count.restart();
  EXPECT_EQ(count.count(1, 4), FrameOrder::kNext);
  EXPECT_EQ(count.missed(), 0U);
}

TEST(ListeningTime, GoesWithTheClockWhileSomebodyLooks) {
  const ListeningTime::Clock::time_point start{};
  ListeningTime time(start);
  for (int look = 1; look <= 20; ++look) EXPECT_EQ(time.look(start + look * 250ms), start + look * 250ms);
}

TEST(ListeningTime, DoesNotCountABreak) {
  const ListeningTime::Clock::time_point start{};
  ListeningTime time(start);
  EXPECT_EQ(time.look(start + 1h), start + ListeningTime::kLongest);
  EXPECT_LT(ListeningTime::kLongest, SourceWatch::kSilence) << "a server that is heard after the break was not silent";
  EXPECT_EQ(time.look(start + 1h + 250ms), start + ListeningTime::kLongest + 250ms);
}

}  // namespace
}  // namespace pelagos
