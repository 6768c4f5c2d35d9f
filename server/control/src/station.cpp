#include "station.hpp"

#include <netinet/tcp.h>

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

#include "messages_out.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using proto::v1::Error;
using proto::v1::Request;
using proto::v1::ServerMessage;

constexpr std::uint32_t kProtocolVersion = 1;
constexpr std::chrono::milliseconds kLinger{1000};
constexpr std::size_t kMostDrained = 1 << 20;
constexpr std::size_t kHeader = 4;
constexpr std::chrono::seconds kGreetingCounts{10};  // for so long a hello alone is as good as a question

/// A peer that vanished without a word (cable out, host down) is noticed within a minute.
void detect_dead_peers(asio::ip::tcp::socket& socket) {
  error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  const auto set = [&](int option, int value) {
    ::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof value);
  };
  set(TCP_KEEPIDLE, 30);
  set(TCP_KEEPINTVL, 10);
  set(TCP_KEEPCNT, 3);
  set(TCP_USER_TIMEOUT, 30'000);
}

std::size_t announced_length(const std::string& input) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < kHeader; ++i) length = (length << 8) | static_cast<unsigned char>(input[i]);
  return length;
}

std::string seconds_text(std::chrono::milliseconds duration) {
  return format_number(static_cast<double>(duration.count()) * 1e-3) + " s";
}

}  // namespace

Station::Station(asio::ip::tcp::socket socket, StationContext& context)
    : context_(context),
      socket_(std::move(socket)),
      deadline_(socket_.get_executor()),
      bucket_(context.options.requests_per_second, context.options.request_burst) {
  error_code error;
  const auto peer = socket_.remote_endpoint(error);
  name_ = error ? "station (gone)" : "station " + peer.address().to_string() + ":" + std::to_string(peer.port());
}

void Station::start() {
  detect_dead_peers(socket_);
  set_deadline();
  read_more();
}

void Station::refuse(Error::Code code, const std::string& text) {
  send(error_message(0, code, text));
  finish();
  read_more();
}

void Station::give_way(bool linger) {
  ++context_.counters.displaced_stations;
  context_.log.write(LogLevel::kWarning, name_ + " has asked nothing and gives way to others");
  send(error_message(0, Error::TOO_MANY_STATIONS,
                     "others need this place, and this station has asked nothing; allowed: " +
                         std::to_string(context_.options.max_stations) +
                         " stations that have sent a valid request, beside hello and subscribe_events; connect again"));
  linger ? finish() : close();
}

Standing Station::standing(Clock::time_point now) const {
  return standing_ == Standing::kGreeted && now - silent_since_ > kGreetingCounts ? Standing::kListens : standing_;
}

/// Valid requests raise a station.
void Station::rise(Request::BodyCase what) {
  const bool takes_events = what == Request::kSubscribeEvents || what == Request::kUnsubscribeEvents;
  const Standing earned = takes_events              ? Standing::kListens
                          : what == Request::kHello ? Standing::kGreeted
                                                    : Standing::kAsked;
  standing_ = std::max(standing_, earned);
  silent_since_ = Clock::now();
  context_.seat(*this);
}

// ---- bytes in

void Station::read_more() {
  socket_.async_read_some(asio::buffer(chunk_), [self = shared_from_this()](error_code error, std::size_t count) {
    if (!self->socket_.is_open()) return;
    if (error) {
      self->peer_ended_ = true;
      if (!self->input_.empty() && !self->closing_) {
        ++self->context_.counters.malformed;
        self->context_.log.write(LogLevel::kWarning, self->name_ + " ended in the middle of a message");
      }
      if (error != asio::error::eof) return self->close();
      self->finish();  // it may still read what was asked for
      return self->shut_when_sent();
    }
    self->take_bytes(count);
    if (self->socket_.is_open()) self->read_more();
  });
}

void Station::take_bytes(std::size_t count) {
  if (closing_) {  // read on for a while, so that the last answer is not lost to a reset
    drained_ += count;
    if (drained_ > kMostDrained) close();
    return;
  }
  input_.append(chunk_.data(), count);
  while (!closing_ && take_message()) message_begun_ = false;
  if (!closing_) set_deadline();
}

/// Cuts one whole message off the input. @return whether there was one
bool Station::take_message() {
  if (input_.size() < kHeader) return false;
  const std::size_t length = announced_length(input_);
  if (length == 0 || length > context_.options.max_message) {
    ++context_.counters.oversize;
    context_.log.write(LogLevel::kWarning,
                       name_ + " announced a message of " + format_count(static_cast<double>(length)) + " bytes");
    send(error_message(0, Error::TOO_LARGE,
                       "a message of " + format_count(static_cast<double>(length)) +
                           " bytes was announced; allowed: 1 to " +
                           format_count(static_cast<double>(context_.options.max_message)) +
                           " (a 4-byte big-endian length, then a Request; see proto/control.proto)"));
    finish();
    return false;
  }
  if (input_.size() < kHeader + length) return false;
  const std::string message = input_.substr(kHeader, length);
  input_.erase(0, kHeader + length);
  handle(message.data(), message.size());
  return socket_.is_open();
}

/// A message under way has until message_timeout after its first byte; between messages idle_timeout counts.
void Station::set_deadline() {
  if (!input_.empty()) {
    if (message_begun_) return;
    message_begun_ = true;
    deadline_.expires_after(context_.options.message_timeout);
  } else {
    message_begun_ = false;
    if (subscribed_) {
      deadline_.cancel();
      return;
    }
    deadline_.expires_after(context_.options.idle_timeout);
  }
  deadline_.async_wait([self = shared_from_this()](error_code error) {
    if (!error) self->on_deadline();
  });
}

void Station::on_deadline() {
  if (!socket_.is_open() || deadline_.expiry() > Clock::now()) return;
  if (closing_) return close();
  if (subscribed_ && !message_begun_) return;  // subscribed while this was on its way
  if (message_begun_) {
    ++context_.counters.malformed;
    context_.log.write(LogLevel::kWarning, name_ + " did not complete a message it had begun");
    send(error_message(
        0, Error::MALFORMED,
        "a message was begun and not completed; allowed: " + seconds_text(context_.options.message_timeout)));
  } else {
    context_.log.write(LogLevel::kInfo, name_ + " asked nothing for " + seconds_text(context_.options.idle_timeout));
  }
  finish();
}

// ---- requests

void Station::handle(const char* data, std::size_t size) {
  Request request;
  if (!request.ParseFromArray(data, static_cast<int>(size))) {
    ++context_.counters.malformed;
    context_.log.write(LogLevel::kWarning, name_ + " sent " + std::to_string(size) + " bytes that are no request");
    send(error_message(0, Error::MALFORMED,
                       "these " + std::to_string(size) + " bytes are no Request of proto/control.proto"));
    finish();
    return;
  }
  if (!within_rate(request.id())) return;
  ++context_.counters.requests;
  const bool greets = request.has_hello() || request.has_subscribe_events() || request.has_unsubscribe_events();
  if (!greets && !context_.has_room_for(*this)) {
    ++context_.counters.refused_stations;
    send(error_message(request.id(), Error::TOO_MANY_STATIONS,
                       std::to_string(context_.options.max_stations) +
                           " stations are connected that have asked something before; allowed: no more; close one and "
                           "try again"));
    return finish();
  }
  valid_ = true;
  try {
    dispatch(request);
    if (valid_ && !closing_) rise(request.body_case());
  } catch (const std::exception& error) {
    context_.log.write(LogLevel::kError, "a request of " + name_ + " failed: " + printable(error.what()));
    send(error_message(request.id(), Error::INTERNAL, "the server failed at this request; its log says more"));
  }
}

bool Station::within_rate(std::uint64_t id) {
  const auto now = Clock::now();
  if (bucket_.take(now)) return true;
  if (now - last_excess_ > std::chrono::seconds(1)) excess_ = 0;
  last_excess_ = now;
  ++context_.counters.rate_limited;
  if (++excess_ == 1) context_.log.write(LogLevel::kWarning, name_ + " asks too often");
  send(error_message(id, Error::RATE_LIMITED,
                     "too many requests; allowed: " + format_number(context_.options.requests_per_second) +
                         " a second, bursts of " + format_number(context_.options.request_burst)));
  if (excess_ > context_.options.tolerated_excess) {
    context_.log.write(LogLevel::kWarning, name_ + " went on asking too often and is let go");
    finish();
  }
  return false;
}

void Station::dispatch(const Request& request) {
  ServerMessage reply;
  reply.mutable_response()->set_id(request.id());
  switch (request.body_case()) {
    case Request::kHello:
      return answer_hello(request);
    case Request::kGetStatus:
      *reply.mutable_response()->mutable_status() =
          to_message(context_.hooks.status(), static_cast<std::size_t>(context_.counters.stations));
      return send(reply);
    case Request::kSubscribeEvents:
    case Request::kUnsubscribeEvents:
      subscribed_ = request.body_case() == Request::kSubscribeEvents;
      return accept(request.id());
    case Request::kCommand:
      return answer_command(request);
    case Request::kGetSchedule:
      return answer_schedule(request);
    case Request::kCancelScheduled:
      return answer_cancel(request);
    case Request::kQueryWind:
      return answer_wind_query(request);
    case Request::kQuerySurface:
      return answer_surface_query(request);
    case Request::BODY_NOT_SET:
      break;
  }
  ++context_.counters.invalid;
  valid_ = false;
  send(error_message(
      request.id(), Error::UNKNOWN_REQUEST,
      "the request has no body that this server knows (protocol version " + std::to_string(kProtocolVersion) + ")"));
}

void Station::answer_hello(const Request& request) {
  const auto& hello = request.hello();
  if (hello.has_protocol_version() && hello.protocol_version() != kProtocolVersion) {
    ++context_.counters.invalid;
    valid_ = false;
    return send(error_message(request.id(), Error::UNSUPPORTED_VERSION,
                              "protocol version " + std::to_string(hello.protocol_version()) +
                                  " is not spoken here; allowed: " + std::to_string(kProtocolVersion),
                              "hello.protocol_version"));
  }
  if (hello.has_station()) {
    context_.log.write(LogLevel::kInfo, name_ + " calls itself \"" + printable(hello.station(), 64) + "\"");
  }
  ServerMessage reply;
  reply.mutable_response()->set_id(request.id());
  auto& body = *reply.mutable_response()->mutable_hello();
  body.set_protocol_version(kProtocolVersion);
  body.set_server_version(kVersion);
  body.set_scene(printable(context_.hooks.status().scene));
  send(reply);
}

// ---- bytes out

void Station::send(const ServerMessage& message) {
  if (replies_.empty()) return push(std::make_shared<const std::string>(frame_message(message)));
  replies_.push_back(std::make_shared<std::optional<ServerMessage>>(message));
}

Station::Reply Station::expect_reply() {
  return replies_.emplace_back(std::make_shared<std::optional<ServerMessage>>());
}

void Station::settle(const Reply& reply, ServerMessage message) {
  *reply = std::move(message);
  flush_replies();
}

void Station::flush_replies() {
  for (; !replies_.empty() && replies_.front()->has_value(); replies_.pop_front())
    push(std::make_shared<const std::string>(frame_message(**replies_.front())));
  if (closing_) shut_when_sent();
}

void Station::send_event(const std::shared_ptr<const std::string>& framed) {
  if (subscribed_ && !closing_) push(framed);
}

void Station::push(std::shared_ptr<const std::string> framed) {
  if (!socket_.is_open()) return;
  unsent_ += framed->size();
  if (unsent_ > context_.options.max_unsent) {
    ++context_.counters.slow_stations;
    context_.log.write(LogLevel::kWarning, name_ + " does not read what it is sent and is dropped");
    return close();
  }
  output_.push_back(std::move(framed));
  if (output_.size() == 1) write_next();
}

void Station::write_next() {
  asio::async_write(socket_, asio::buffer(*output_.front()),
                    [self = shared_from_this()](error_code error, std::size_t) {
                      if (!self->socket_.is_open()) return;
                      if (error) return self->close();
                      self->unsent_ -= self->output_.front()->size();
                      self->output_.pop_front();
                      if (!self->output_.empty()) return self->write_next();
                      if (self->closing_) self->shut_when_sent();
                    });
}

void Station::finish() {
  if (closing_ || !socket_.is_open()) return;
  closing_ = true;
  input_.clear();
  deadline_.expires_after(kLinger);
  deadline_.async_wait([self = shared_from_this()](error_code error) {
    if (!error) self->on_deadline();
  });
  shut_when_sent();
}

void Station::shut_when_sent() {
  if (!socket_.is_open() || !output_.empty() || !replies_.empty()) return;
  if (peer_ended_) return close();
  if (shut_) return;
  shut_ = true;
  error_code ignored;
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
}

void Station::close() {
  if (!socket_.is_open()) return;
  closing_ = true;
  error_code ignored;
  socket_.close(ignored);
  deadline_.cancel();
  context_.gone(*this);
}

}  // namespace pelagos
