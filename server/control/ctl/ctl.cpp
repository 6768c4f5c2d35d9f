#include "ctl.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <ostream>

#include "command_line.hpp"
#include "command_line/parse.hpp"
#include "control_client.hpp"
#include "print.hpp"
#include "surface_command.hpp"
#include "text/printable.hpp"

namespace pelagos {
namespace {

using proto::v1::Request;
using proto::v1::Response;

std::string error_text(const proto::v1::Error& error) {
  return error.message() + " [" + proto::v1::Error::Code_Name(error.code()) + "]";
}

int print_error(const proto::v1::Error& error, bool json, std::ostream& out, std::ostream& err) {
  if (json) out << nlohmann::ordered_json{{"ok", false}, {"error", to_json(error)}}.dump() << "\n";
  err << "pelagos-ctl: refused: " << printable_lines(error_text(error)) << "\n";
  return 1;
}

/// @param timed  whether the command came with a time
std::string scheduled_text(std::uint64_t id, bool timed) {
  const std::string text = "scheduled as " + std::to_string(id);
  return timed ? text
               : text +
                     ": the server still places and settles its water; the first step decides, and an event and the "
                     "status tell if it refuses";
}

int print_response(const Request& request, const Response& response, bool json, std::ostream& out, std::ostream& err) {
  if (response.has_error()) return print_error(response.error(), json, out, err);
  if (response.has_status()) {
    if (json) {
      out << to_json(response.status()).dump() << "\n";
    } else {
      out << printable_lines(describe(response.status()));
    }
    return 0;
  }
  if (response.has_schedule()) {
    out << (json ? to_json(response.schedule()).dump() + "\n" : printable_lines(describe(response.schedule())));
    return 0;
  }
  if (response.has_wind_reading()) {
    out << (json ? to_json(response.wind_reading()).dump() + "\n" : printable_lines(describe(response.wind_reading())));
    return 0;
  }
  if (response.has_surface_answer()) {
    out << (json ? to_json(response.surface_answer()).dump() + "\n"
                 : printable_lines(describe(request.query_surface(), response.surface_answer())));
    return 0;
  }
  const std::uint64_t id = response.accepted().scheduled_id();
  if (json) {
    nlohmann::ordered_json done{{"ok", true}};
    if (id > 0) done["scheduled_id"] = id;
    out << done.dump() << "\n";
  } else {
    out << (id > 0 ? scheduled_text(id, request.command().has_at()) : "done") << "\n";
  }
  return 0;
}

int follow_events(ControlClient& client, const CtlOptions& options, std::ostream& out, std::ostream& err) {
  using std::chrono::milliseconds;
  Request request;
  request.mutable_subscribe_events();
  const Response response = client.ask(request);
  if (response.has_error()) return print_error(response.error(), options.json, out, err);
  const auto start = std::chrono::steady_clock::now();
  const milliseconds duration(static_cast<std::int64_t>(options.event_duration * 1e3));
  std::uint64_t count = 0;
  while (out && (options.event_count == 0 || count < options.event_count)) {
    milliseconds wait = std::chrono::hours(1);
    if (options.event_duration > 0.0) {
      wait = duration - std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
      if (wait <= milliseconds(0)) break;
    }
    const auto event = client.next_event(wait);
    if (!event) continue;
    ++count;
    if (options.json) {
      out << to_json(*event).dump() << "\n";
    } else {
      out << printable(describe(*event), 4096) << "\n";
    }
    out.flush();
  }
  if (count < options.event_count) {
    err << "pelagos-ctl: " << count << " of " << options.event_count << " events came within " << options.event_duration
        << " s\n";
    return 1;
  }
  return 0;
}

int run_command(const CommandLine& line, std::ostream& out, std::ostream& err) {
  const CtlOptions& options = line.options;
  if (const std::string fault = usage_fault(line); !fault.empty()) {
    err << "pelagos-ctl: " << fault << "\n";
    return 2;
  }
  const EndpointResult server = parse_endpoint(options.server);
  if (!server.endpoint || server.endpoint->port == 0) {
    err << "pelagos-ctl: --server: "
        << (server.endpoint ? "port 0 is none to connect to; allowed: 1 to 65535" : server.error) << "\n";
    return 2;
  }
  const RequestResult request = to_request(line);
  if (!request.fault.empty()) {
    err << "pelagos-ctl: " << request.fault << "\n";
    return 2;
  }
  ControlClient client(*server.endpoint, std::chrono::milliseconds(static_cast<std::int64_t>(options.timeout * 1e3)));
  if (line.events->parsed()) return follow_events(client, options, out, err);
  return print_response(request.request, client.ask(request.request), options.json, out, err);
}

}  // namespace

int run_ctl(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  CommandLine line;
  if (const auto status = parse_command_line(line.app, argc, argv, out, err)) return *status;
  try {
    return run_command(line, out, err);
  } catch (const std::exception& error) {
    if (line.options.json) {
      out << nlohmann::ordered_json{{"ok", false}, {"error", {{"code", "UNREACHABLE"}, {"message", error.what()}}}}
                 .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
          << "\n";
    }
    err << "pelagos-ctl: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace pelagos
