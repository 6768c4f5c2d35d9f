#include "control_fixture.hpp"

namespace pelagos {
namespace {

using test::RawStation;
using test::Request;

class ControlEvents : public test::ControlTest {
 protected:
  static void subscribe(RawStation& station) {
    Request request;
    request.set_id(1);
    request.mutable_subscribe_events();
    const auto reply = station.ask(request);
    ASSERT_TRUE(reply);
    EXPECT_TRUE(reply->response().has_accepted());
  }
  static Event event(std::uint64_t sequence) {
    return {sequence, 10 * sequence, 0.5, "wind", "station 127.0.0.1:9", "12 m/s from 270"};
  }
};

TEST_F(ControlEvents, ReachEveryStationThatAskedForThem) {
  RawStation first(port());
  RawStation second(port());
  RawStation other(port());
  subscribe(first);
  subscribe(second);
  for (std::uint64_t i = 1; i <= 3; ++i) server().broadcast(event(i));
  for (RawStation* station : {&first, &second}) {
    for (std::uint64_t i = 1; i <= 3; ++i) {
      const auto message = station->read();
      ASSERT_TRUE(message && message->has_event());
      EXPECT_EQ(message->event().sequence(), i);
      EXPECT_EQ(message->event().step(), 10 * i);
      EXPECT_EQ(message->event().simulation_time(), 0.5);
      EXPECT_EQ(message->event().kind(), "wind");
      EXPECT_EQ(message->event().source(), "station 127.0.0.1:9");
      EXPECT_EQ(message->event().text(), "12 m/s from 270");
    }
  }
  Request request;
  request.mutable_get_status();
  const auto reply = other.ask(request);  // the first thing that this one is sent
  ASSERT_TRUE(reply);
  EXPECT_TRUE(reply->has_response());
  EXPECT_EQ(server().statistics().events, 3u);
}

TEST_F(ControlEvents, StopAfterUnsubscribing) {
  RawStation station(port());
  subscribe(station);
  server().broadcast(event(1));
  ASSERT_TRUE(station.read()->has_event());
  Request request;
  request.set_id(2);
  request.mutable_unsubscribe_events();
  ASSERT_TRUE(station.ask(request)->response().has_accepted());
  server().broadcast(event(2));
  request.set_id(3);
  request.mutable_get_status();
  const auto reply = station.ask(request);
  ASSERT_TRUE(reply && reply->has_response());
  EXPECT_EQ(reply->response().id(), 3u);
}

TEST_F(ControlEvents, ComeFromManyThreadsWithoutLoss) {
  RawStation station(port());
  subscribe(station);
  constexpr int kThreads = 4;
  constexpr int kEach = 100;  // 400 in all: far below what may be pending, so none may be lost
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this] {
      for (int i = 0; i < kEach; ++i) server().broadcast(event(1));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kThreads * kEach; ++i) ASSERT_TRUE(station.read()->has_event()) << i;
  EXPECT_EQ(server().statistics().events_lost, 0u);
}

}  // namespace
}  // namespace pelagos
