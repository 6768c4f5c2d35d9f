#include <algorithm>
#include <atomic>
#include <deque>

#include "control_fixture.hpp"

namespace pelagos {
namespace {

using test::Error;
using test::RawStation;
using test::Request;
using testing::HasSubstr;

class ControlAbuse : public test::ControlTest {};

Request status_request(std::uint64_t id) {
  Request request;
  request.set_id(id);
  request.mutable_get_status();
  return request;
}

TEST_F(ControlAbuse, OversizeIsAnsweredCountedAndClosed) {
  for (const std::size_t announced : {std::size_t{64 * 1024 + 1}, std::size_t{0xffffffff}, std::size_t{0}}) {
    RawStation station(port());
    station.send_bytes(RawStation::frame("", announced));
    const auto reply = station.read();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->response().error().code(), Error::TOO_LARGE);
    EXPECT_THAT(reply->response().error().message(), HasSubstr("1 to 65,536"));
    EXPECT_TRUE(station.at_end());
  }
  EXPECT_EQ(server().statistics().oversize, 3u);
  expect_unharmed();
}

TEST_F(ControlAbuse, TheLargestMessageIsTaken) {
  RawStation station(port());
  Request request = status_request(4);
  request.GetReflection()->MutableUnknownFields(&request)->AddLengthDelimited(1000, std::string(65000, 'x'));
  const auto reply = station.ask(request);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().id(), 4u);
}

TEST_F(ControlAbuse, AWebBrowserIsTold) {
  RawStation station(port());
  station.send_bytes("GET / HTTP/1.1\r\nHost: localhost\r\nUser-Agent: " + std::string(20000, 'x') + "\r\n\r\n");
  const auto reply = station.read();
  ASSERT_TRUE(reply);  // not lost to a reset, though much was left unread
  EXPECT_EQ(reply->response().error().code(), Error::TOO_LARGE);
  expect_unharmed();
}

TEST_F(ControlAbuse, GarbageIsAnsweredCountedAndClosed) {
  RawStation station(port());
  station.send_bytes(RawStation::frame("\xff\xff\xff\xff garbage"));
  const auto reply = station.read();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().error().code(), Error::MALFORMED);
  EXPECT_TRUE(station.at_end());
  EXPECT_EQ(server().statistics().malformed, 1u);
  EXPECT_THAT(log(), HasSubstr("that are no request"));
  expect_unharmed();
}

TEST_F(ControlAbuse, RandomBytesNeverHarm) {
  std::uint32_t state = 7;
  for (int round = 0; round < 40; ++round) {
    std::string body;
    for (int i = 0; i < 300; ++i) {
      state = state * 1664525u + 1013904223u;
      body.push_back(static_cast<char>(state >> 24));
    }
    RawStation station(port());
    station.send_bytes(round % 2 == 0 ? RawStation::frame(body) : body);
    station.end_sending();
    EXPECT_TRUE(station.at_end());
  }
  EXPECT_TRUE(commands().empty());
  expect_unharmed();
}

TEST_F(ControlAbuse, StringsThatAreNotTextDoNotReachStderr) {
  testing::internal::CaptureStderr();
  {
    RawStation station(port());
    station.send_bytes(RawStation::frame("\x12\x04\x12\x02\xff\xfe"));  // hello { station: <not UTF-8> }
    const auto reply = station.read();
    EXPECT_TRUE(reply && reply->response().error().code() == Error::MALFORMED);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ControlAbuse, DeeplyNestedBytesNeverHarm) {
  std::string nested;  // groups that open and never end
  nested.assign(60000, '\x0b');
  RawStation station(port());
  station.send_bytes(RawStation::frame(nested));
  const auto reply = station.read();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().error().code(), Error::MALFORMED);
  expect_unharmed();
}

TEST_F(ControlAbuse, HalfMessagesAreCountedWhenTheLinkEnds) {
  for (const std::size_t bytes : {1u, 3u, 4u, 6u}) {
    RawStation station(port());
    station.send_bytes(RawStation::frame(status_request(1).SerializeAsString(), 100).substr(0, bytes));
    station.end_sending();
    EXPECT_TRUE(station.at_end());
  }
  EXPECT_TRUE(eventually([&] { return server().statistics().malformed == 4; }));
  EXPECT_THAT(log(), HasSubstr("in the middle of a message"));
  expect_unharmed();
}

TEST_F(ControlAbuse, HalfMessagesThatStallAreClosed) {
  options_.message_timeout = std::chrono::milliseconds(100);
  RawStation station(port());
  const std::string half = RawStation::frame("abc", 100);
  const auto start = std::chrono::steady_clock::now();
  bool open = true;
  for (std::size_t i = 0; open && i < half.size(); ++i) {  // a byte now and then does not extend the time
    open = station.send_bytes(half.substr(i, 1));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const auto reply = station.read();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().error().code(), Error::MALFORMED);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100));
  EXPECT_TRUE(station.at_end());
  expect_unharmed();
}

TEST_F(ControlAbuse, MessagesInSmallPiecesAreTaken) {
  RawStation station(port());
  const std::string framed = RawStation::frame(status_request(6).SerializeAsString());
  for (const char byte : framed) {
    ASSERT_TRUE(station.send_bytes(std::string(1, byte)));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const auto reply = station.read();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().id(), 6u);
}

TEST_F(ControlAbuse, ManyMessagesInOnePieceAreAnsweredInOrderEvenAfterTheLastByte) {
  RawStation station(port());
  std::string framed;
  for (std::uint64_t id = 1; id <= 50; ++id) framed += RawStation::frame(status_request(id).SerializeAsString());
  station.send_bytes(framed);
  station.end_sending();
  for (std::uint64_t id = 1; id <= 50; ++id) {
    const auto reply = station.read();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->response().id(), id);
  }
  EXPECT_TRUE(station.at_end());
}

TEST_F(ControlAbuse, AFloodIsLimitedAndInTheEndClosedWhileOthersAreServed) {
  options_.requests_per_second = 1.0;
  options_.request_burst = 10.0;
  options_.tolerated_excess = 20;
  RawStation flooding(port());
  std::string flood;
  for (std::uint64_t id = 1; id <= 500; ++id) flood += RawStation::frame(status_request(id).SerializeAsString());
  flooding.send_bytes(flood);
  int served = 0;
  int limited = 0;
  while (const auto reply = flooding.read()) {
    if (reply->response().has_status()) ++served;
    if (reply->response().error().code() == Error::RATE_LIMITED) ++limited;
  }
  EXPECT_GE(served, 10);
  EXPECT_LE(served, 20);  // 10 at once, then one a second: far from ten seconds pass here
  EXPECT_EQ(limited, 21);
  EXPECT_TRUE(flooding.at_end());
  EXPECT_EQ(server().statistics().rate_limited, 21u);
  expect_unharmed();
}

TEST_F(ControlAbuse, StationsBeyondTheLimitAreToldAndPlacesComeFree) {
  options_.max_stations = 2;
  RawStation first(port());
  ASSERT_TRUE(first.ask(status_request(1)));
  {
    RawStation second(port());
    ASSERT_TRUE(second.ask(status_request(1)));
    RawStation third(port());
    const auto reply = third.read();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->response().error().code(), Error::TOO_MANY_STATIONS);
    EXPECT_TRUE(third.at_end());
  }
  EXPECT_EQ(server().statistics().refused_stations, 1u);
  EXPECT_TRUE(eventually([&] { return server().statistics().stations == 1; }));
  expect_unharmed();
}

TEST_F(ControlAbuse, ManyLinksThatSayNothingDoNotPileUp) {
  options_.max_waiting = 4;
  std::vector<std::unique_ptr<RawStation>> idle;
  for (int i = 0; i < 60; ++i) idle.push_back(std::make_unique<RawStation>(port()));
  EXPECT_TRUE(eventually([&] { return server().statistics().displaced_stations == 56; }));
  EXPECT_EQ(server().statistics().stations, 4u) << "who still reads why it was let go counts no more";
  EXPECT_EQ(server().statistics().refused_stations, 0u);
  const auto reply = idle.front()->read();  // the longest silent go first, and are told
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->response().error().code(), Error::TOO_MANY_STATIONS);
  EXPECT_THAT(reply->response().error().message(), HasSubstr("has asked nothing"));
  idle.clear();
  EXPECT_TRUE(eventually([&] { return server().statistics().stations == 0; }));
  expect_unharmed();
}

Request subscription() {
  Request request;
  request.mutable_subscribe_events();
  return request;
}

Request greeting() {
  Request request;
  request.mutable_hello()->set_station("test");
  return request;
}

std::vector<std::unique_ptr<RawStation>> links_that_asked(std::uint16_t port, const Request& request, int count) {
  std::vector<std::unique_ptr<RawStation>> links;
  for (int i = 0; i < count; ++i) {
    links.push_back(std::make_unique<RawStation>(port));
    EXPECT_TRUE(links.back()->ask(request));
  }
  return links;
}

TEST_F(ControlAbuse, SilentLinksLockNobodyOut) {
  options_.max_stations = 2;
  options_.max_waiting = 8;
  RawStation known(port());
  ASSERT_TRUE(known.ask(status_request(1)));
  std::vector<std::unique_ptr<RawStation>> silent;
  for (int i = 0; i < 40; ++i) {
    silent.push_back(std::make_unique<RawStation>(port()));
    if (i % 3 == 1) silent.back()->send_bytes("\x01");                        // half a header
    if (i % 3 == 2) silent.back()->send_bytes(RawStation::frame("abc", 60));  // half a message
  }
  RawStation newcomer(port());
  EXPECT_TRUE(newcomer.ask(status_request(2)));
  for (int i = 0; i < 40; ++i) silent.push_back(std::make_unique<RawStation>(port()));
  for (RawStation* station : {&known, &newcomer}) {
    const auto reply = station->ask(status_request(3));
    ASSERT_TRUE(reply);
    EXPECT_TRUE(reply->response().has_status());
  }
}

TEST_F(ControlAbuse, LinksThatOnlyTakeEventsOrSayHelloGiveWay) {
  options_.max_stations = 4;
  for (const Request& little : {subscription(), greeting()}) {
    const auto links = links_that_asked(port(), little, 4);
    std::vector<std::unique_ptr<RawStation>> instructors;
    for (int i = 0; i < 4; ++i) {
      instructors.push_back(std::make_unique<RawStation>(port()));
      ASSERT_TRUE(instructors.back()->ask(greeting()));
      const auto reply = instructors.back()->ask(status_request(2));
      ASSERT_TRUE(reply);
      EXPECT_TRUE(reply->response().has_status());
    }
    for (const auto& link : links) {
      const auto reply = link->read();
      ASSERT_TRUE(reply);
      EXPECT_EQ(reply->response().error().code(), Error::TOO_MANY_STATIONS);
      EXPECT_TRUE(link->at_end());
    }
    instructors.clear();
    ASSERT_TRUE(eventually([&] { return server().statistics().stations == 0; }));
  }
}

TEST_F(ControlAbuse, WrongRequestsEarnNoPlace) {
  options_.max_stations = 1;
  Request wrong;
  wrong.mutable_command()->mutable_set_wind()->mutable_wind()->set_beaufort(-1);
  const auto links = links_that_asked(port(), wrong, 3);
  RawStation instructor(port());
  const auto reply = instructor.ask(status_request(1));
  ASSERT_TRUE(reply);
  EXPECT_TRUE(reply->response().has_status());
}

TEST_F(ControlAbuse, StationsThatAskedKeepTheirPlaces) {
  options_.max_stations = 3;
  const auto known = links_that_asked(port(), status_request(1), 2);
  RawStation waiting(port());  // came while there was room
  RawStation third(port());
  ASSERT_TRUE(third.ask(status_request(1)));
  const auto late = waiting.ask(status_request(9));
  ASSERT_TRUE(late);
  EXPECT_EQ(late->response().id(), 9u);
  EXPECT_EQ(late->response().error().code(), Error::TOO_MANY_STATIONS);
  EXPECT_TRUE(third.ask(status_request(2)));
  for (const auto& station : known) EXPECT_TRUE(station->ask(status_request(3)));
}

TEST_F(ControlAbuse, AFloodOfNewLinksNeitherDropsNorLocksOutAnInstructor) {
  options_.max_stations = 4;
  const std::uint16_t where = port();
  RawStation known(where);
  ASSERT_TRUE(known.ask(subscription()));
  ASSERT_TRUE(known.ask(status_request(1)));
  std::atomic<bool> stop{false};
  std::atomic<int> opened{0};
  std::thread flood([&] {
    std::deque<std::unique_ptr<RawStation>> open;
    for (int i = 0; !stop; ++i, ++opened) {
      open.push_back(std::make_unique<RawStation>(where));
      if (i % 2 == 0) open.back()->send(subscription());
      if (open.size() > 300) open.pop_front();
    }
  });
  for (int round = 0; round < 8; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    bool in = false;
    while (!in && std::chrono::steady_clock::now() - begin < std::chrono::seconds(5)) {  // 1 s, on a busy machine 5
      RawStation newcomer(where);
      const auto reply = newcomer.ask(status_request(2));
      in = reply && reply->response().has_status();
    }
    EXPECT_TRUE(in);
    const auto reply = known.ask(status_request(3));
    ASSERT_TRUE(reply);
    EXPECT_TRUE(reply->response().has_status());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  stop = true;
  flood.join();
  EXPECT_GT(opened, 300);
  const std::string lines = log();
  EXPECT_LT(std::count(lines.begin(), lines.end(), '\n'), 60);  // 20 of each level, and 20 a minute
}

TEST_F(ControlAbuse, AFloodOfGarbageWritesFewLines) {
  for (int i = 0; i < 500; ++i) {
    RawStation station(port());
    station.send_bytes(RawStation::frame("\xff\xff garbage"));
    EXPECT_TRUE(station.read());
  }
  EXPECT_EQ(server().statistics().malformed, 500u);
  const std::string lines = log();
  EXPECT_LT(std::count(lines.begin(), lines.end(), '\n'), 60);
}

TEST_F(ControlAbuse, IdleStationsAreLetGoButNotThoseThatTakeEvents) {
  options_.idle_timeout = std::chrono::milliseconds(100);
  RawStation listening(port());
  Request subscribe;
  subscribe.mutable_subscribe_events();
  ASSERT_TRUE(listening.ask(subscribe));
  {
    RawStation idle(port());
    EXPECT_TRUE(idle.at_end());
  }
  EXPECT_TRUE(eventually([&] { return server().statistics().stations == 1; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(150));  // longer than the limit
  EXPECT_TRUE(listening.ask(status_request(2)));
}

TEST_F(ControlAbuse, AStationThatDoesNotReadIsDroppedAndOthersAreServed) {
  options_.max_unsent = 64 * 1024;
  RawStation slow(port(), 4096);
  Request subscribe;
  subscribe.mutable_subscribe_events();
  ASSERT_TRUE(slow.ask(subscribe));
  Event event;
  event.kind = "test";
  event.text = std::string(900, 'x');
  // The socket's own buffers hold some megabytes before anything waits.
  EXPECT_TRUE(eventually([&] {
    for (int i = 0; i < 500; ++i) server().broadcast(event);
    return server().statistics().slow_stations == 1;
  }));
  EXPECT_TRUE(eventually([&] { return log().find("does not read") != std::string::npos; }));
  expect_unharmed();
}

TEST_F(ControlAbuse, APortInUseIsNamedWithAdvice) {
  ControlOptions again;
  again.port = port();
  try {
    const ControlServer second(again, {});
    FAIL() << "two servers on one port";
  } catch (const ControlError& error) {
    EXPECT_THAT(error.what(), HasSubstr("127.0.0.1:" + std::to_string(again.port)));
    EXPECT_THAT(error.what(), HasSubstr("another pelagos-server"));
  }
  expect_unharmed();
}

TEST_F(ControlAbuse, AddressesOfOthersAreRefused) {
  ControlOptions options;
  options.port = 0;
  for (const char* host : {"192.0.2.1", "no.such.host", ""}) {  // 192.0.2.0/24 is kept free for documents
    options.host = host;
    EXPECT_THROW(ControlServer(options, {}), ControlError) << host;
  }
}

TEST_F(ControlAbuse, StopsAtOnceWithStationsInEveryState) {
  RawStation quiet(port());
  RawStation half(port());
  half.send_bytes("\x01");
  RawStation busy(port());
  ASSERT_TRUE(busy.ask(status_request(1)));
  const auto start = std::chrono::steady_clock::now();
  stop();
  // The server's own share of the second that SIGTERM allows.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
  EXPECT_TRUE(quiet.at_end());
  EXPECT_TRUE(half.at_end());
  EXPECT_TRUE(busy.at_end());
}

}  // namespace
}  // namespace pelagos
