#include "control/control_server.hpp"

#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <set>
#include <thread>
#include <utility>

#include "control/endpoint.hpp"
#include "messages_out.hpp"
#include "station.hpp"

namespace pelagos {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr int kMostPendingEvents = 4096;
constexpr std::size_t kMostLeaving = 64;  // stations that may still read why they were let go

tcp::endpoint resolve(const ControlOptions& options) {
  const std::string host = options.host == "localhost" ? "127.0.0.1" : options.host;
  error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (error) {
    throw ControlError("control: \"" + printable(options.host) +
                       "\" is no numeric address to listen on; allowed: an address of this machine, e.g. 127.0.0.1, or "
                       "0.0.0.0 for all of them");
  }
  return {address, options.port};
}

tcp::acceptor listen(asio::io_context& io, const ControlOptions& options) {
  const tcp::endpoint endpoint = resolve(options);
  const std::string where = to_string(Endpoint{options.host, options.port});
  tcp::acceptor acceptor(io);
  try {
    acceptor.open(endpoint.protocol());
    acceptor.set_option(tcp::acceptor::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    std::string advice;
    if (error.code() == asio::error::address_in_use) {
      advice = "; is another pelagos-server running? Stop it, or choose another port (0 takes any free one)";
    } else if (error.code() == asio::error::access_denied) {
      advice = "; ports below 1024 need privileges: choose a higher one";
    } else {
      advice = "; choose an address of this machine";
    }
    throw ControlError("control: cannot listen on " + where + ": " + error.code().message() + advice);
  }
  return acceptor;
}

}  // namespace

class ControlServer::Impl {
 public:
  Impl(const ControlOptions& options, ControlHooks hooks)
      : options_(options), hooks_(std::move(hooks)), log_(hooks_.log), acceptor_(listen(io_, options)), retry_(io_) {
    // Protobuf writes a line to stderr for each string that is not UTF-8; we count and log such requests ourselves.
    google::protobuf::SetLogHandler(nullptr);
    context_.gone = [this](Station& station) { forget(station); };
    context_.has_room_for = [this](const Station& station) { return has_room_for(station); };
    context_.seat = [this](Station& station) { seat(station); };
    port_ = acceptor_.local_endpoint().port();
    accept_next();
    thread_ = std::thread([this] { run(); });
  }

  ~Impl() {
    asio::post(io_, [this] { stop(); });
    thread_.join();
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] const ControlCounters& counters() const { return counters_; }

  void broadcast(const Event& event) {
    ++counters_.events;
    if (pending_events_.fetch_add(1) >= kMostPendingEvents) {
      --pending_events_;
      ++counters_.events_lost;
      return;
    }
    asio::post(io_, [this, event] {
      --pending_events_;
      const auto framed = std::make_shared<const std::string>(frame_message(to_message(event)));
      const auto stations = stations_;  // a slow station leaves the set on the way
      for (const auto& station : stations) station->send_event(framed);
    });
  }

 private:
  /// Nothing that a station sends may end the thread.
  void run() {
    while (true) {
      try {
        io_.run();
        return;
      } catch (const std::exception& error) {
        log_.write(LogLevel::kError, "a handler failed: " + printable(error.what()));
      }
    }
  }

  void stop() {
    stopping_ = true;
    error_code ignored;
    acceptor_.close(ignored);
    retry_.cancel();
    const auto stations = stations_;
    for (const auto& station : stations) station->close();
    stations_.clear();
  }

  void accept_next() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (stopping_) return;
      if (error) return accept_later(error);
      admit(std::move(socket));
      accept_next();
    });
  }

  /// Out of file descriptors, for instance: wait for some to come free instead of spinning.
  void accept_later(error_code error) {
    log_.write(LogLevel::kWarning, "cannot take a station: " + error.message());
    retry_.expires_after(std::chrono::milliseconds(100));
    retry_.async_wait([this](error_code cancelled) {
      if (!cancelled && !stopping_) accept_next();
    });
  }

  /// Whoever comes waits until a valid request earns a place. Where too many wait, those that have done least go, the
  /// longest silent first: a flood of silent links displaces its own.
  void admit(tcp::socket socket) {
    const bool full = seated() >= options_.max_stations && least_seated(Standing::kAsked) == nullptr;
    if (full) {
      ++counters_.refused_stations;
      log_.write(LogLevel::kWarning,
                 "one station too many was refused (" + std::to_string(seated()) + " are connected)");
      if (leaving() >= kMostLeaving) return;  // not even words for it
    } else if (waiting() >= options_.max_waiting) {
      if (Station* const least = least_waiting()) send_away(*least, leaving() < kMostLeaving);
    }
    const auto station = std::make_shared<Station>(std::move(socket), context_);
    stations_.insert(station);
    if (full) {
      return station->refuse(proto::v1::Error::TOO_MANY_STATIONS,
                             std::to_string(seated()) + " stations are connected; allowed: " +
                                 std::to_string(options_.max_stations) + "; close one and try again");
    }
    ++counters_.accepted_stations;
    ++counters_.stations;
    admitted_.insert(station.get());
    station->start();
  }

  [[nodiscard]] std::size_t count(bool seated, bool closing) const {
    return static_cast<std::size_t>(std::count_if(stations_.begin(), stations_.end(), [&](const auto& s) {
      return s->closing() == closing && (closing || s->seated() == seated);
    }));
  }
  [[nodiscard]] std::size_t seated() const { return count(true, false); }
  [[nodiscard]] std::size_t waiting() const { return count(false, false); }
  [[nodiscard]] std::size_t leaving() const { return count(false, true); }

  /// Of those with or without a place the one that has done least, the longest silent of these; null if there is none.
  [[nodiscard]] Station* least(bool with_place) const {
    const auto now = Clock::now();
    Station* found = nullptr;
    for (const auto& station : stations_) {
      if (station->closing() || station->seated() != with_place) continue;
      if (found == nullptr || std::pair(station->standing(now), station->silent_since()) <
                                  std::pair(found->standing(now), found->silent_since()))
        found = station.get();
    }
    return found;
  }
  [[nodiscard]] Station* least_waiting() const { return least(false); }
  /// A station whose place one of `standing` may have.
  [[nodiscard]] Station* least_seated(Standing standing) const {
    Station* const found = least(true);
    return found != nullptr && found->standing(Clock::now()) < standing ? found : nullptr;
  }

  [[nodiscard]] bool has_room_for(const Station& station) const {
    return station.seated() || seated() < options_.max_stations || least_seated(Standing::kAsked) != nullptr;
  }

  void seat(Station& station) {
    if (station.seated()) return;
    if (seated() >= options_.max_stations) {
      Station* const least = least_seated(station.standing(Clock::now()));
      if (least == nullptr) return;  // it goes on waiting, and is served meanwhile
      send_away(*least, true);
    }
    station.set_seated(true);
  }

  /// It may read why for a while, but counts no more.
  void send_away(Station& station, bool linger) {
    const auto alive = station.shared_from_this();
    station.give_way(linger);
    uncount(station);
  }

  void uncount(const Station& station) {
    if (admitted_.erase(&station) > 0) --counters_.stations;
  }

  void forget(Station& station) {
    uncount(station);
    stations_.erase(station.shared_from_this());
  }

  const ControlOptions options_;
  const ControlHooks hooks_;
  LimitedLog log_;
  ControlCounters counters_;
  StationContext context_{options_, hooks_, log_, counters_, {}, {}, {}};
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer retry_;
  std::uint16_t port_ = 0;
  std::set<std::shared_ptr<Station>> stations_;
  std::set<const Station*> admitted_;
  std::atomic<int> pending_events_{0};
  bool stopping_ = false;
  std::thread thread_;
};

ControlServer::ControlServer(const ControlOptions& options, ControlHooks hooks)
    : impl_(std::make_unique<Impl>(options, std::move(hooks))) {}
ControlServer::~ControlServer() = default;

std::uint16_t ControlServer::port() const { return impl_->port(); }
void ControlServer::broadcast(const Event& event) { impl_->broadcast(event); }

ControlStatistics ControlServer::statistics() const {
  const ControlCounters& c = impl_->counters();
  ControlStatistics statistics;
  statistics.stations = c.stations;
  statistics.accepted_stations = c.accepted_stations;
  statistics.refused_stations = c.refused_stations;
  statistics.displaced_stations = c.displaced_stations;
  statistics.requests = c.requests;
  statistics.malformed = c.malformed;
  statistics.oversize = c.oversize;
  statistics.invalid = c.invalid;
  statistics.rate_limited = c.rate_limited;
  statistics.slow_stations = c.slow_stations;
  statistics.events = c.events;
  statistics.events_lost = c.events_lost;
  return statistics;
}

}  // namespace pelagos
