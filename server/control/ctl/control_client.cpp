#include "control_client.hpp"

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

namespace pelagos {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr std::size_t kHeader = 4;
constexpr std::size_t kLargestMessage = 1 << 20;  // a status with 64 bodies takes 8 KB
constexpr std::size_t kMostEventsKept = 10000;

std::string frame(const proto::v1::Request& request) {
  const std::string body = request.SerializeAsString();
  std::string framed;
  for (int shift = 24; shift >= 0; shift -= 8) framed.push_back(static_cast<char>((body.size() >> shift) & 0xffu));
  return framed + body;
}

std::size_t announced_length(const std::string& input) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < kHeader; ++i) length = (length << 8) | static_cast<unsigned char>(input[i]);
  return length;
}

std::string seconds_text(std::chrono::milliseconds duration) {
  std::string text = std::to_string(static_cast<double>(duration.count()) * 1e-3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

}  // namespace

struct ControlClient::Link {
  asio::io_context io{1};
  asio::ip::tcp::socket socket{io};
  std::array<char, 8192> chunk{};
};

ControlClient::ControlClient(const Endpoint& server, std::chrono::milliseconds timeout)
    : server_(server), timeout_(timeout), link_(std::make_unique<Link>()) {
  connect();
  read_more();
}

ControlClient::~ControlClient() = default;

void ControlClient::connect() {
  error_code error;
  asio::ip::tcp::resolver resolver(link_->io);
  const auto addresses = resolver.resolve(server_.host, std::to_string(server_.port), error);
  if (error) {
    throw ClientError("no such host: \"" + server_.host + "\" (" + error.message() +
                      "); give the server's address with --server HOST:PORT");
  }
  error = asio::error::would_block;
  asio::async_connect(link_->socket, addresses,
                      [&](error_code result, const asio::ip::tcp::endpoint&) { error = result; });
  link_->io.restart();
  link_->io.run_for(timeout_);
  if (error == asio::error::would_block) {
    link_->socket.close();
    link_->io.restart();
    link_->io.run();
    throw ClientError("no answer from " + to_string(server_) + " within " + seconds_text(timeout_) +
                      "; is the address right, and does a firewall stand between?");
  }
  if (error == asio::error::connection_refused) {
    throw ClientError("connection refused: is pelagos-server running at " + to_string(server_) +
                      "? Start it with: pelagos-server --scene FILE --control " + to_string(server_));
  }
  if (error) throw ClientError("cannot connect to " + to_string(server_) + ": " + error.message());
  link_->socket.set_option(asio::ip::tcp::no_delay(true), error);
}

std::string ControlClient::trouble() const { return "the link to " + to_string(server_) + " ended: " + failure_; }

proto::v1::Response ControlClient::ask(proto::v1::Request request) {
  request.set_id(++last_id_);
  const auto deadline = Clock::now() + timeout_;
  send(frame(request), deadline);
  while (true) {
    while (!responses_.empty()) {
      proto::v1::Response response = std::move(responses_.front());
      responses_.pop_front();
      // An answer under id 0 is about bytes that could not be read: ours.
      if (response.id() == last_id_ || (response.id() == 0 && response.has_error())) return response;
    }
    if (!failure_.empty()) throw ClientError(trouble());
    if (link_->io.run_one_until(deadline) == 0) {
      throw ClientError(to_string(server_) + " did not answer within " + seconds_text(timeout_) +
                        "; is it a pelagos-server, and is it overloaded? Allow more with --timeout S");
    }
  }
}

std::optional<proto::v1::Event> ControlClient::next_event(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (events_.empty()) {
    if (!failure_.empty()) throw ClientError(trouble());
    if (link_->io.run_one_until(deadline) == 0) return std::nullopt;
  }
  proto::v1::Event event = std::move(events_.front());
  events_.pop_front();
  return event;
}

void ControlClient::send(const std::string& framed, Clock::time_point deadline) {
  bool sent = false;
  link_->io.restart();
  asio::async_write(link_->socket, asio::buffer(framed), [&](error_code, std::size_t) {
    sent = true;  // if it failed, reading tells why: the server may have said it before it closed
  });
  while (!sent) {
    if (link_->io.run_one_until(deadline) > 0) continue;
    link_->socket.close();  // cancels the write, which holds references to this frame
    link_->io.restart();
    link_->io.run();
    throw ClientError(to_string(server_) + " took no request within " + seconds_text(timeout_));
  }
}

void ControlClient::read_more() {
  link_->socket.async_read_some(asio::buffer(link_->chunk), [this](error_code error, std::size_t count) {
    if (error) {
      if (failure_.empty()) {
        failure_ = error == asio::error::eof ? "closed by the server" : error.message();
      }
      return;
    }
    input_.append(link_->chunk.data(), count);
    take_messages();
    if (failure_.empty()) read_more();
  });
}

void ControlClient::take_messages() {
  while (input_.size() >= kHeader) {
    const std::size_t length = announced_length(input_);
    if (length == 0 || length > kLargestMessage) {
      failure_ = "what answers there does not speak the Pelagos control protocol";
      return;
    }
    if (input_.size() < kHeader + length) return;
    proto::v1::ServerMessage message;
    if (!message.ParseFromArray(input_.data() + kHeader, static_cast<int>(length))) {
      failure_ = "it sent a message that cannot be read";
      return;
    }
    input_.erase(0, kHeader + length);
    if (message.has_response()) responses_.push_back(message.response());
    if (message.has_event()) events_.push_back(message.event());
    if (events_.size() > kMostEventsKept) events_.pop_front();
  }
}

}  // namespace pelagos
