#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "control.pb.h"
#include "control/endpoint.hpp"

namespace pelagos {

/// The link failed; what() says how and what to do.
class ClientError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A station's end of the instructors' link (proto/control.proto): blocking, for one thread.
class ControlClient {
 public:
  /// Connects. @throws ClientError
  ControlClient(const Endpoint& server, std::chrono::milliseconds timeout);
  ~ControlClient();

  /// Sends a request under an id of its own and waits for its response; events that come in between are kept.
  /// @throws ClientError if the link ends or the timeout passes
  [[nodiscard]] proto::v1::Response ask(proto::v1::Request request);

  /// The next event, or nothing if none comes in time. @throws ClientError if the link ends
  [[nodiscard]] std::optional<proto::v1::Event> next_event(std::chrono::milliseconds timeout);

 private:
  using Clock = std::chrono::steady_clock;
  void connect();
  void send(const std::string& framed, Clock::time_point deadline);
  void read_more();
  void take_messages();
  [[nodiscard]] std::string trouble() const;

  Endpoint server_;
  std::chrono::milliseconds timeout_;
  struct Link;  ///< the socket
  std::unique_ptr<Link> link_;
  std::string input_;
  std::string failure_;  ///< why the link ended; empty while it stands
  std::deque<proto::v1::Response> responses_;
  std::deque<proto::v1::Event> events_;
  std::uint64_t last_id_ = 0;
};

}  // namespace pelagos
