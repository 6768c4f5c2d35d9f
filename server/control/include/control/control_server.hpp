#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "text/refusal.hpp"
#include "values/air_reading.hpp"
#include "values/command.hpp"
#include "values/command_answer.hpp"
#include "values/command_surroundings.hpp"
#include "values/status.hpp"
#include "values/surface_query.hpp"

namespace pelagos {

/// Where the instructors' link listens, and what it takes from stations (proto/control.proto is the contract).
struct ControlOptions {
  std::string host = "127.0.0.1";       ///< address of one interface; 0.0.0.0 for all. There is no encryption: see docs
  std::uint16_t port = 7410;            ///< 0: any free one, told by ControlServer::port()
  std::size_t max_stations = 32;        ///< with a place of their own: that have sent a valid request
  std::size_t max_waiting = 256;        ///< beside them: that have not yet, or wait for a place
  std::size_t max_message = 64 * 1024;  ///< bytes of one request
  std::size_t max_unsent = 1024 * 1024;  ///< bytes waiting for one station before it is dropped
  double requests_per_second = 50.0;     ///< of one station, sustained
  double request_burst = 100.0;          ///< requests at once
  int tolerated_excess = 200;            ///< RATE_LIMITED answers without a second's rest before the link is closed
  std::chrono::milliseconds message_timeout{5000};  ///< from a message's first byte to its last
  std::chrono::milliseconds idle_timeout{600'000};  ///< without a request, for stations that take no events
};

enum class LogLevel { kInfo, kWarning, kError };

/// What became of a command with a time.
struct ScheduleAnswer {
  enum class Outcome {
    kTaken,    ///< it waits under `id`
    kPast,     ///< its time has passed: it is `present_time` already
    kRefused,  ///< it cannot be taken now: `refusal`
  };
  Outcome outcome = Outcome::kTaken;
  std::uint64_t id = 0;
  double present_time = 0.0;  ///< s, simulated
  Refusal refusal;
};

/// What the link needs from the program around it. All are called on the link's own thread, must return at once, and
/// must be callable until ControlServer's destructor returns. An exception out of one of them, `log` apart, is
/// answered INTERNAL.
struct ControlHooks {
  /// Takes a well-formed command for the next step boundary; `answer` is called from there, or when the server ends.
  /// @return nothing, or why it cannot be taken now: then `answer` is not called
  /// @param source  e.g. "station 127.0.0.1:40112", for events and logs
  std::function<std::optional<Refusal>(const Command& command, const std::string& source, TakeAnswer answer)> submit;
  /// Takes a well-formed command for the first step boundary at or after `at` (s, simulated).
  std::function<ScheduleAnswer(const Command& command, double at, const std::string& source)> schedule;
  /// Takes a command out of the schedule; false if none waits under that id.
  std::function<bool(std::uint64_t id, const std::string& source)> cancel;
  /// All that wait, in the order in which they fall due.
  std::function<std::vector<ScheduledCommand>()> scheduled;
  /// What the scene alone tells against a command that is to wait for its time.
  std::function<std::optional<Refusal>(const Command& command)> find_refusal;
  std::function<ServerStatus()> status;
  /// The air as it moves now at each of the places (m, world).
  std::function<AirReading(const std::vector<Eigen::Vector3d>& position)> read_air;
  /// Takes a query of the surface. A refusal with a field is of a value, named as in a QuerySurface.
  AskSurface ask_surface;
  std::function<void(LogLevel level, std::string_view text)> log;  ///< 20 lines at once, then about 20 a minute
};

/// The link cannot be opened; what() names the address and what to do.
class ControlError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Counts since the start.
struct ControlStatistics {
  std::uint64_t stations = 0;            ///< connected now
  std::uint64_t accepted_stations = 0;   ///< since the start
  std::uint64_t refused_stations = 0;    ///< beyond max_stations
  std::uint64_t displaced_stations = 0;  ///< that had asked little or nothing and gave way to others
  std::uint64_t requests = 0;            ///< whole and readable
  std::uint64_t malformed = 0;           ///< unreadable, half, or overdue messages
  std::uint64_t oversize = 0;            ///< announced lengths of 0 or beyond the limit
  std::uint64_t invalid = 0;             ///< readable requests refused for a value or a missing body
  std::uint64_t rate_limited = 0;
  std::uint64_t slow_stations = 0;  ///< dropped because they did not read
  std::uint64_t events = 0;         ///< broadcast
  std::uint64_t events_lost = 0;    ///< broadcast faster than the link could take them
};

/// Serves instructors' stations over TCP on a thread of its own, from construction to destruction. A station that sends
/// garbage, half messages or floods, or reads nothing, costs itself its link and nobody else anything.
class ControlServer {
 public:
  /// Listens at once. @throws ControlError if it cannot
  ControlServer(const ControlOptions& options, ControlHooks hooks);
  /// Closes all links and joins the thread.
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

  /// Sends an event to all stations that subscribed. From any thread; never blocks (takes a lock for an instant).
  void broadcast(const Event& event);

  [[nodiscard]] ControlStatistics statistics() const;  ///< from any thread

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pelagos
