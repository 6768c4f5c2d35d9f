#pragma once

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <deque>
#include <functional>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "control.pb.h"
#include "control/control_server.hpp"

namespace pelagos::test {

using proto::v1::Error;
using proto::v1::Request;
using proto::v1::ServerMessage;

/// Far beyond what an answer over loopback takes, so that only a missing one fails, on a busy machine too.
constexpr int kPatienceSeconds = 10;

/// A station that may send anything: a bare socket.
class RawStation {
 public:
  explicit RawStation(std::uint16_t port, int receive_buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    const timeval patience{kPatienceSeconds, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, static_cast<sockaddr*>(static_cast<void*>(&address)), sizeof address) == 0;
    EXPECT_TRUE(connected_);
  }
  ~RawStation() { ::close(socket_); }
  RawStation(const RawStation&) = delete;
  RawStation& operator=(const RawStation&) = delete;

  /// @return whether all of it was taken
  bool send_bytes(const std::string& bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return false;
      sent += static_cast<std::size_t>(n);
    }
    return true;
  }
  bool send(const Request& request) { return send_bytes(frame(request.SerializeAsString())); }

  static std::string frame(const std::string& body, std::optional<std::size_t> announced = std::nullopt) {
    const std::size_t size = announced.value_or(body.size());
    std::string framed;
    for (int shift = 24; shift >= 0; shift -= 8) framed.push_back(static_cast<char>((size >> shift) & 0xffu));
    return framed + body;
  }

  void end_sending() { ::shutdown(socket_, SHUT_WR); }

  /// The next message, or nothing at the end of the link (or after kPatienceSeconds).
  std::optional<ServerMessage> read() {
    const std::optional<std::string> header = read_bytes(4);
    if (!header) return std::nullopt;
    std::size_t length = 0;
    for (const char byte : *header) length = (length << 8) | static_cast<unsigned char>(byte);
    EXPECT_GT(length, 0u);
    EXPECT_LE(length, std::size_t{1} << 20);
    const std::optional<std::string> body = read_bytes(length);
    if (!body) return std::nullopt;
    ServerMessage message;
    EXPECT_TRUE(message.ParseFromString(*body));
    return message;
  }
  std::optional<ServerMessage> ask(const Request& request) {
    if (!send(request)) return std::nullopt;
    return read();
  }
  /// Whether the server has closed the link, all that it sent before read away.
  bool at_end() {
    char byte;
    ssize_t n;
    while ((n = ::recv(socket_, &byte, 1, 0)) > 0) {
    }
    return n == 0 || errno == ECONNRESET;
  }

 private:
  std::optional<std::string> read_bytes(std::size_t count) {
    std::string bytes(count, '\0');
    std::size_t got = 0;
    while (got < count) {
      const ssize_t n = ::recv(socket_, bytes.data() + got, count - got, 0);
      if (n <= 0) return std::nullopt;
      got += static_cast<std::size_t>(n);
    }
    return bytes;
  }

  int socket_;
  bool connected_ = false;
};

/// A server on a free port of loopback, which notes what it is asked to do.
class ControlTest : public testing::Test {
 protected:
  ControlTest() { options_.port = 0; }
  ~ControlTest() override { server_.reset(); }

  ControlServer& server() {
    if (!server_) server_ = std::make_unique<ControlServer>(options_, hooks());
    return *server_;
  }
  std::uint16_t port() { return server().port(); }
  void stop() { server_.reset(); }

  std::vector<Command> commands() {
    const std::lock_guard lock(mutex_);
    return commands_;
  }
  std::vector<ScheduledCommand> scheduled() {
    const std::lock_guard lock(mutex_);
    return scheduled_;
  }
  /// Answers the command that was submitted first of those that wait. @return false: none waits
  bool release_answer() {
    const std::lock_guard lock(mutex_);
    if (held_.empty()) return false;
    held_.front()();
    held_.pop_front();
    return true;
  }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }
  /// Waits until the condition holds.
  template <typename Condition>
  static bool eventually(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(kPatienceSeconds);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  /// A whole session of a well-behaved station: the server is unharmed.
  void expect_unharmed() {
    RawStation station(port());
    Request request;
    request.set_id(77);
    request.mutable_get_status();
    const auto reply = station.ask(request);
    ASSERT_TRUE(reply && reply->has_response());
    EXPECT_EQ(reply->response().id(), 77u);
    EXPECT_EQ(reply->response().status().scene(), "test");
  }

  ControlOptions options_;
  /// Stands in for the air: rises with x, turns with y, still below z = 0.
  static Eigen::Vector3d air_at(const Eigen::Vector3d& place) {
    return place.z() > 0.0 ? Eigen::Vector3d(place.x(), place.y(), 0.5) : Eigen::Vector3d::Zero();
  }

  /// Stands in for the surface: a plane that rises to the east; no water west of x = -1000.
  SurfaceAnswer surface_at(const SurfaceQuery& query) const {
    SurfaceAnswer answer{status_.simulation_time + query.ahead, {}};
    for (const Eigen::Vector2d& place : query.places) {
      SurfaceAtPlace& at = answer.places.emplace_back();
      if (place.x() < -1000.0) continue;
      at.source = query.ahead > 0.0 || place.x() > 100.0 ? SurfaceSource::kWaveField
                  : place.x() > 50.0                     ? SurfaceSource::kBlended
                                                         : SurfaceSource::kParticles;
      at.height = 0.25 * place.x();
      at.normal = Eigen::Vector3d(-0.25, 0.0, 1.0).normalized();
      at.velocity = {1.5, -0.25, 0.125};
    }
    return answer;
  }

  ServerStatus status_;                                                              // set before the server starts
  CommandSurroundings around_{{{0, 0, 0}, {60, 40, 16}}, {1, 2}, OilModel::kSlick};  // likewise
  std::optional<std::string> refusal_;                                               // likewise
  bool throws_ = false;                                                              // likewise
  bool holds_answers_ = false;                                                       // likewise: until release_answer
  static constexpr std::uint64_t kStep = 77;                                         // that commands take effect before
  double now_ = 0.0;  // likewise: s, the present simulated time

 private:
  ControlHooks hooks() {
    status_.scene = "test";
    ControlHooks hooks;
    hooks.submit = [this](const Command& command, const std::string& source,
                          TakeAnswer answer) -> std::optional<Refusal> {
      EXPECT_THAT(source, testing::StartsWith("station 127.0.0.1:"));
      if (throws_) throw std::runtime_error("broken");
      if (refusal_) return Refusal{"", *refusal_};
      const std::lock_guard lock(mutex_);
      if (holds_answers_)
        held_.push_back([this, command, answer] { answer({kStep, take(command)}); });
      else
        answer({kStep, take(command)});
      return std::nullopt;
    };
    hooks.schedule = [this](const Command& command, double at, const std::string& source) -> ScheduleAnswer {
      if (at < now_) return {ScheduleAnswer::Outcome::kPast, 0, now_, {}};
      if (refusal_) return {ScheduleAnswer::Outcome::kRefused, 0, now_, {"", *refusal_}};
      const std::lock_guard lock(mutex_);
      scheduled_.push_back({scheduled_.size() + 1, at, command, source});
      return {ScheduleAnswer::Outcome::kTaken, scheduled_.size(), now_, {}};
    };
    hooks.cancel = [this](std::uint64_t id, const std::string&) {
      const std::lock_guard lock(mutex_);
      return std::erase_if(scheduled_, [id](const ScheduledCommand& waiting) { return waiting.id == id; }) > 0;
    };
    hooks.scheduled = [this] { return scheduled(); };
    hooks.find_refusal = [this](const Command& command) { return find_refusal(command, around_); };
    hooks.status = [this] { return status_; };
    hooks.read_air = [this](const std::vector<Eigen::Vector3d>& position) {
      if (throws_) throw std::runtime_error("broken");
      AirReading reading{status_.simulation_time, {}};
      for (const Eigen::Vector3d& place : position) reading.velocity.push_back(air_at(place));
      return reading;
    };
    hooks.ask_surface = [this](const SurfaceQuery& query, const std::string& client,
                               const TakeSurface& take) -> std::optional<Refusal> {
      EXPECT_THAT(client, testing::StartsWith("station 127.0.0.1:"));
      if (throws_) throw std::runtime_error("broken");
      if (auto fault = find_fault(query)) return fault;
      if (refusal_) return Refusal{"", *refusal_};
      take({surface_at(query), ""});
      return std::nullopt;
    };
    hooks.log = [this](LogLevel, std::string_view text) {
      const std::lock_guard lock(mutex_);
      log_ += std::string(text) + "\n";
    };
    return hooks;
  }

  /// Stands in for the world at a step boundary.
  std::optional<Refusal> take(const Command& command) {
    if (auto refusal = find_refusal(command, around_)) return refusal;
    if (std::holds_alternative<ClearWind>(command)) status_.wind.reset();
    const auto* set = std::get_if<SetWind>(&command);
    if (set == nullptr) {
      commands_.push_back(command);
      return {};
    }
    WindSettings wind;
    if (auto refusal = merge_wind(*set, status_.wind, wind)) return refusal;
    status_.wind = wind;
    commands_.push_back(SetWind{wind, set->ramp_seconds});
    return {};
  }

  std::mutex mutex_;
  std::vector<Command> commands_;
  std::deque<std::function<void()>> held_;
  std::vector<ScheduledCommand> scheduled_;
  std::string log_;
  std::unique_ptr<ControlServer> server_;
};

}  // namespace pelagos::test
