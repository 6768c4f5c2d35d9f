#pragma once

#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "control.pb.h"
#include "limits.hpp"
#include "messages/field_reader.hpp"

namespace pelagos {

/// Counted on the link's thread, read from any.
struct ControlCounters {
  std::atomic<std::uint64_t> accepted_stations{0}, refused_stations{0}, displaced_stations{0}, requests{0},
      malformed{0}, oversize{0}, invalid{0}, rate_limited{0}, slow_stations{0}, events{0}, events_lost{0}, stations{0};
};

/// What a station has done so far; those that have done least give way first. `kGreeted` without more falls back to
/// `kListens` after a while.
enum class Standing {
  kStranger,  ///< no valid request
  kListens,   ///< only said hello, some time ago, or takes events
  kGreeted,   ///< said hello just now
  kAsked,     ///< has asked or commanded something
};

/// What all stations of a server share; used on the link's thread only.
struct StationContext {
  const ControlOptions& options;
  const ControlHooks& hooks;
  LimitedLog& log;
  ControlCounters& counters;
  std::function<void(class Station&)> gone;
  /// Whether a station may ask or command: it has a place, or one can be made free for it.
  std::function<bool(const class Station&)> has_room_for;
  /// Gives the station a place for what it has just become, if there is one.
  std::function<void(class Station&)> seat;
};

/// One instructor's link: cuts the bytes into requests, answers each, and queues events. All on the link's thread.
class Station : public std::enable_shared_from_this<Station> {
 public:
  Station(boost::asio::ip::tcp::socket socket, StationContext& context);

  void start();
  /// Answers with an error and closes.
  void refuse(proto::v1::Error::Code code, const std::string& text);
  void send_event(const std::shared_ptr<const std::string>& framed);
  void close();

  /// Tells a station that others need its place, and closes. @param linger  whether to wait until it has read that
  void give_way(bool linger);

  [[nodiscard]] bool closing() const { return closing_; }
  [[nodiscard]] Standing standing(Clock::time_point now) const;
  [[nodiscard]] bool seated() const { return seated_; }
  void set_seated(bool seated) { seated_ = seated; }
  /// Since the last valid request, or since it came.
  [[nodiscard]] Clock::time_point silent_since() const { return silent_since_; }
  [[nodiscard]] bool subscribed() const { return subscribed_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  void read_more();
  void take_bytes(std::size_t count);
  bool take_message();
  void set_deadline();
  void on_deadline();

  void handle(const char* data, std::size_t size);
  [[nodiscard]] bool within_rate(std::uint64_t id);
  void dispatch(const proto::v1::Request& request);
  void rise(proto::v1::Request::BodyCase what);
  void answer_hello(const proto::v1::Request& request);
  void answer_command(const proto::v1::Request& request);
  void answer_schedule(const proto::v1::Request& request);
  void answer_cancel(const proto::v1::Request& request);
  void answer_wind_query(const proto::v1::Request& request);
  void answer_surface_query(const proto::v1::Request& request);
  /// @param path  of the command in the request, for what is refused later
  void submit(std::uint64_t id, const std::string& path, const Command& command);
  void schedule(std::uint64_t id, const Command& command, double at);
  void refuse_values(std::uint64_t id, const TextRefusals& faults);
  /// @param scheduled_id  0: the command was not scheduled
  void accept(std::uint64_t id, std::uint64_t scheduled_id = 0);

  /// Answers go out in the order of the requests: one that is still to come holds back those behind it.
  using Reply = std::shared_ptr<std::optional<proto::v1::ServerMessage>>;
  Reply expect_reply();
  /// How a reply that is still to come is given, from any thread.
  [[nodiscard]] std::function<void(proto::v1::ServerMessage, bool refused)> reply_later(const Reply& reply);
  void settle(const Reply& reply, proto::v1::ServerMessage message);
  void flush_replies();
  void send(const proto::v1::ServerMessage& message);
  void push(std::shared_ptr<const std::string> framed);
  void write_next();
  /// Sends what is queued, then closes: nothing more is read as requests.
  void finish();
  void shut_when_sent();

  StationContext& context_;
  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer deadline_;
  std::string name_;  ///< "station ADDRESS:PORT"
  std::array<char, 8192> chunk_{};
  std::string input_;  ///< bytes of the message under way
  std::deque<std::shared_ptr<const std::string>> output_;
  std::deque<Reply> replies_;  ///< to requests that wait for an answer, and to those behind them
  std::size_t unsent_ = 0;
  TokenBucket bucket_;
  int excess_ = 0;
  Clock::time_point last_excess_{};
  std::size_t drained_ = 0;
  Standing standing_ = Standing::kStranger;
  Clock::time_point silent_since_ = Clock::now();
  bool seated_ = false;
  bool valid_ = true;  ///< the request that is being answered
  bool message_begun_ = false;
  bool subscribed_ = false;
  bool closing_ = false;
  bool peer_ended_ = false;
  bool shut_ = false;
};

}  // namespace pelagos
