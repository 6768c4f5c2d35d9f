// The schedule and the clock of the server, over DDS.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "loopback.hpp"
#include "transport/clock_link.hpp"
#include "wire/convert.hpp"
#include "wire/sample_fault.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kAhead = 987'654'321'000'000;  // ns, of the server's clock

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

class Clock : public Loopback {
 protected:
  void start_with_clock() {
    start();
    link_ = std::make_unique<ClockLink>(participant_, publisher_->source(), [] { return steady_ns() + kAhead; });
  }
  /// A piece that begins now.
  SchedulePiece tell(double time, double rate, std::uint64_t era = 1) {
    const SchedulePiece piece{era, steady_ns() + kAhead, LocalClocks{}.now().utc_ns, time, rate, 1e6};
    publisher_->publish_schedule(piece);
    return piece;
  }
  std::unique_ptr<ClockLink> link_;
};

TEST_F(Clock, IsMeasuredAndTheScheduleReadByIt) {
  start_with_clock();
  ASSERT_TRUE(pass(1, 10));
  const SchedulePiece piece = tell(500.0, 2.0);
  ASSERT_TRUE(eventually([&] { return receiver_->clock_state().clock == ViewerClock::kMeasured; }));
  const ClockState state = receiver_->clock_state();
  EXPECT_LE(std::abs(1e-9 * static_cast<double>(state.offset_ns - kAhead)), state.error + 1e-9);
  ASSERT_TRUE(eventually([&] { return receiver_->due_at(steady_ns())->clock == ViewerClock::kMeasured; }));
  const double due = receiver_->due_at(piece.clock_ns - kAhead + 1000 * kMs)->scheduled.time;
  EXPECT_NEAR(due, 502.0, 2.0 * state.error + 1e-3);
}

TEST_F(Clock, ErrorOfAMachineWithoutOtherWorkIsMilliseconds) {
  start_with_clock();
  ASSERT_TRUE(pass(1, 10));
  tell(0.0, 1.0);
  // Sixteen answers, of which one meets no other work.
  ASSERT_TRUE(eventually([&] {
    const ClockState state = receiver_->clock_state();
    return state.measured && state.measured->answers >= 4 && state.error < 4e-3;
  }));
}

TEST_F(Clock, OfTheHostIsUsedWhereTheOperatorSaysSo) {
  start_with_clock();
  FrameReceiver trusting(test_settings(), {{}, true});
  ASSERT_TRUE(eventually([&] { return trusting.scene_info().has_value(); }));
  ASSERT_TRUE(eventually([&] {
    tell(500.0, 1.0);
    return trusting.clock_state().clock == ViewerClock::kHost;
  }));
  EXPECT_NEAR(1e-9 * static_cast<double>(trusting.clock_state().offset_ns - kAhead), 0.0, 1e-3);
  EXPECT_TRUE(eventually([&] { return trusting.clock_state().measured.has_value(); })) << "to be compared with";
}

TEST_F(Clock, AViewerWhoseClockIsOffIsCorrected) {
  start_with_clock();
  FrameReceiver off(test_settings(), {[] { return steady_ns() + 300 * kMs; }, false});
  ASSERT_TRUE(eventually([&] { return off.scene_info().has_value(); }));
  const SchedulePiece piece = tell(0.0, 1.0);
  ASSERT_TRUE(eventually([&] { return off.clock_state().clock == ViewerClock::kMeasured; }));
  const ClockState state = off.clock_state();
  EXPECT_NEAR(1e-9 * static_cast<double>(state.offset_ns - kAhead), -0.3, state.error + 1e-9);
  const std::int64_t now = piece.clock_ns - kAhead + 1000 * kMs;  // by the true clock
  EXPECT_NEAR(off.due_at(now + 300 * kMs)->scheduled.time, 1.0, state.error + 1e-6);
}

TEST_F(Clock, WithoutAScheduleFramesAreShownByTheirArrival) {
  start();
  EXPECT_FALSE(receiver_->due_at(steady_ns()));
  EXPECT_EQ(receiver_->clock_state().clock, ViewerClock::kNone);
  const auto frame = pass(30, 10);
  ASSERT_TRUE(frame);
  ASSERT_EQ(receiver_->clock_state().clock, ViewerClock::kArrival);
  EXPECT_FALSE(frame->completed_ns);
  EXPECT_NEAR(receiver_->due_at(frame->received_ns + 100 * kMs)->scheduled.time, 1.1, 1e-9);
  EXPECT_NEAR(receiver_->due_at(frame->received_ns + 9000 * kMs)->scheduled.time, 1.2, 1e-9) << "then it holds";
}

TEST_F(Clock, FramesKnowWhenTheyWereCompleted) {
  start_with_clock();
  const SchedulePiece piece = tell(0.0, 1.0);
  ASSERT_TRUE(pass(1, 10));
  std::unique_ptr<OceanFrame> frame;
  ASSERT_TRUE(eventually([&] {
    auto snapshot = test_snapshot(*publisher_, 2, 10);
    snapshot->wall_time_ns = piece.utc_ns + 7 * kMs;
    publisher_->submit(std::move(snapshot));
    frame = receiver_->take_newest();
    return frame && frame->completed_ns;
  }));
  EXPECT_EQ(frame->completed_ns, piece.clock_ns + 7 * kMs);
}

TEST_F(Clock, AFrameBringsThePieceThatItMade) {
  start_with_clock();
  auto snapshot = test_snapshot(*publisher_, 1, 10);
  const ClockStamp now = LocalClocks{}.now();
  snapshot->schedule = SchedulePiece{1, now.clock_ns + kAhead, now.utc_ns, 40.0, 0.0, 40.0};
  publisher_->submit(std::move(snapshot));
  EXPECT_TRUE(eventually([&] {
    const auto due = receiver_->due_at(steady_ns());
    return due && due->clock == ViewerClock::kMeasured && due->scheduled.time == 40.0;
  }));
  EXPECT_FALSE(publisher_->acquire()->schedule) << "a snapshot that is used again has none";
}

TEST_F(Clock, FramesWaitInTheirOrder) {
  start();
  for (std::uint64_t number = 1; number <= 3; ++number) {
    publisher_->submit(test_snapshot(*publisher_, number, 10));
    ASSERT_TRUE(eventually([&] { return receiver_->counters().received == number; }));
  }
  for (std::uint64_t number = 1; number <= 3; ++number) EXPECT_EQ(receiver_->take_next()->frame, number);
  EXPECT_FALSE(receiver_->take_next());
  for (std::uint64_t number = 4; number <= 40; ++number) {
    publisher_->submit(test_snapshot(*publisher_, number, 10));
    ASSERT_TRUE(eventually([&] { return receiver_->counters().received == number; }));
  }
  EXPECT_EQ(receiver_->take_next()->frame, 25U) << "sixteen wait";
  EXPECT_EQ(receiver_->counters().replaced, 21U);
}

TEST_F(Clock, AnswersOfStrangersAreRefused) {
  start_with_clock();
  ASSERT_TRUE(pass(1, 10));
  tell(0.0, 1.0);
  ASSERT_TRUE(eventually([&] { return receiver_->clock_state().clock == ViewerClock::kMeasured; }));
  const DdsParticipant stranger(test_settings());
  const DdsWriter answers(stranger, topics::clock_answer()), schedules(stranger, topics::schedule());
  const DdsReader requests(stranger, topics::clock_request());
  std::uint64_t client = 0, number = 0;
  ASSERT_TRUE(eventually([&] {  // whom to answer, and which request
    requests.take_all<pelagos_ClockRequestV1>([&](const pelagos_ClockRequestV1& request) {
      client = request.client;
      number = request.number;
    });
    return number > 0 && answers.matched_readers() > 0;
  }));
  const pelagos_ClockAnswerV1 extreme{
      publisher_->source(), client, number, 0, std::numeric_limits<std::int64_t>::max(), 0};
  const pelagos_ClockAnswerV1 unasked{publisher_->source(), client, number + 1000, 5, 6, 7};
  const pelagos_ScheduleV1 no_number{publisher_->source(), 1, 0, 0, std::numeric_limits<double>::quiet_NaN(), 1.0, 1.0};
  const pelagos_ScheduleV1 elsewhere{publisher_->source(), 9, steady_ns() + kAhead, 0, 1e6, 0.0, 1e6};
  const std::uint64_t refused = receiver_->counters().others_refused, intruding = receiver_->counters().intruding;
  EXPECT_TRUE(answers.write(&extreme) && answers.write(&unasked) && schedules.write(&no_number) &&
              schedules.write(&elsewhere));
  EXPECT_TRUE(eventually([&] {
    return receiver_->counters().others_refused >= refused + 2 && receiver_->counters().intruding >= intruding + 2;
  }));
  EXPECT_NEAR(1e-9 * static_cast<double>(receiver_->clock_state().offset_ns - kAhead), 0.0,
              receiver_->clock_state().error + 1e-9);
  EXPECT_LT(receiver_->due_at(steady_ns())->scheduled.time, 1e3);
}

TEST_F(Clock, ALimitedNumberOfRequestsIsAnswered) {
  start_with_clock();
  const DdsParticipant peer(test_settings());
  const DdsWriter requests(peer, topics::clock_request());
  const DdsReader answers(peer, topics::clock_answer());
  ASSERT_TRUE(eventually([&] { return requests.matched_readers() > 0; }));
  std::uint64_t answered = 0;
  const auto count = [&] {
    answers.take_all<pelagos_ClockAnswerV1>(
        [&](const pelagos_ClockAnswerV1& a) { answered += a.client == 77 ? 1 : 0; });
  };
  for (std::uint64_t k = 0; k < 200; ++k) {
    const pelagos_ClockRequestV1 request{77, k, steady_ns()};
    EXPECT_TRUE(requests.write(&request));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    count();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  count();
  EXPECT_GE(answered, 1U);
  EXPECT_LT(answered, 60U) << "ten at once and ten a second";
}

TEST(ScheduleFault, NamesTheField) {
  const auto fault = [](double time, double rate, double limit, std::int64_t clock = 0) {
    const pelagos_ScheduleV1 sample{1, 1, clock, 0, time, rate, limit};
    const auto found = wire::find_fault(sample);
    return found ? to_string(*found) : "";
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault(1.0, 1.0, 2.0), "");
  EXPECT_THAT(fault(kNaN, 1.0, 2.0), HasSubstr("time: is nan"));
  EXPECT_THAT(fault(1.0, -1.0, 2.0), HasSubstr("rate: is -1; allowed: 0 to"));
  EXPECT_THAT(fault(1.0, 1e9, 2.0), HasSubstr("rate: is 1e+09"));
  EXPECT_THAT(fault(1.0, 1.0, kNaN), HasSubstr("limit: is nan"));
  EXPECT_THAT(fault(1.0, 1.0, 2.0, std::numeric_limits<std::int64_t>::min()),
              HasSubstr("clock_ns: is -9223372036854775808"));
}

TEST_F(Clock, AViewerTellsHowItDoes) {
  start_with_clock();
  ASSERT_TRUE(pass(1, 10));
  const DdsReader statuses(*participant_, topics::viewer_status());
  ViewerStatus status;
  status.channel = "centre" + std::string(100, 'x');
  status.pictures = 3;
  status.skew_99 = 0.004;
  status.delay = 0.1;
  std::optional<ViewerStatus> told;
  ASSERT_TRUE(eventually([&] {
    receiver_->tell(status);
    statuses.take_all<pelagos_ViewerStatusV1>([&](const pelagos_ViewerStatusV1& sample) {
      EXPECT_FALSE(wire::find_fault(sample));
      told = wire::from_wire(sample);
    });
    return told.has_value();
  }));
  EXPECT_EQ(told->channel.size(), 64U);
  EXPECT_EQ(told->source, publisher_->source());
  EXPECT_EQ(told->skew_99, 0.004);
  EXPECT_NE(told->viewer, 0U);
}

}  // namespace
}  // namespace pelagos
