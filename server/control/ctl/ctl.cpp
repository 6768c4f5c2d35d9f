#include "ctl.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <ostream>

#include "control_client.hpp"
#include "print.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

using proto::v1::Request;
using proto::v1::Response;

constexpr const char* kExamples = R"(Examples:
  pelagos-ctl status                                   how the server is doing
  pelagos-ctl status --json                            the same for machines
  pelagos-ctl wind --speed 12 --from 270               12 m/s from the west, at once
  pelagos-ctl wind --beaufort 7 --from 200 --ramp 10   rising to force 7 within 10 s
  pelagos-ctl wind --from 290                          the wind veers, all else stays
  pelagos-ctl wind --period 8 --width 3                blows 3 s of every 8 s
  pelagos-ctl wind --off
  pelagos-ctl pause; pelagos-ctl step 10; pelagos-ctl resume
  pelagos-ctl events --count 5                         the next five events
  pelagos-ctl --server 192.168.1.20:7410 status

Exit status: 0 done; 1 refused or not reachable; 2 wrong command line.)";

struct WindOptions {
  double speed = 0, from = 0, ramp = 0, amplitude = 0, length = 0, beta = 0, period = 0, width = 0, roughness = 0;
  std::string law;
  int beaufort = 0;
  std::vector<double> velocity;
  bool off = false;
  bool no_pulse = false;
};

struct CtlOptions {
  std::string server = "127.0.0.1:7410";
  double timeout = 5.0;
  bool json = false;
  WindOptions wind;
  std::uint32_t steps = 1;
  std::uint64_t event_count = 0;  // 0: no limit
  double event_duration = 0.0;    // 0: no limit
};

/// What was asked for, read by the functions below from the parsed command line.
struct CommandLine {
  CLI::App app{"Asks a running pelagos-server for its status, and commands it: wind, pause, resume, single steps."};
  CtlOptions options;
  CLI::App* status = nullptr;
  CLI::App* wind = nullptr;
  CLI::App* pause = nullptr;
  CLI::App* resume = nullptr;
  CLI::App* step = nullptr;
  CLI::App* events = nullptr;

  CommandLine();
  void add_wind_options();
};

CommandLine::CommandLine() {
  app.name("pelagos-ctl");
  app.fallthrough();  // --json and --server may stand after the command too
  app.require_subcommand(1);
  app.footer(kExamples);
  app.set_version_flag("--version", std::string("pelagos-ctl ") + kVersion);
  app.add_option("--server", options.server, "Where the server listens, HOST:PORT")
      ->envname("PELAGOS_SERVER")
      ->capture_default_str();
  app.add_option("--timeout", options.timeout, "Longest wait for an answer, s")
      ->check(CLI::Range(0.05, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", options.json, "Print JSON, one object a line");

  status = app.add_subcommand("status", "Print how the server is doing");
  wind = app.add_subcommand("wind", "Change the wind; what is not given stays as it is");
  pause = app.add_subcommand("pause", "Stop simulated time");
  resume = app.add_subcommand("resume", "Let simulated time go on");
  step = app.add_subcommand("step", "While paused, advance by some time steps");
  events = app.add_subcommand("events", "Print events as they happen");
  add_wind_options();
  step->add_option("steps", options.steps, "How many (1 to 10000)")->capture_default_str();
  events->add_option("--count", options.event_count, "Stop after so many")->check(CLI::Range(1.0, 1e15));
  events->add_option("--duration", options.event_duration, "Stop after so many seconds")->check(CLI::Range(0.01, 1e9));
}

void CommandLine::add_wind_options() {
  WindOptions& w = options.wind;
  CLI::Option* speed = wind->add_option("--speed", w.speed, "Mean speed at 10 m, m/s (0 to 75)");
  CLI::Option* beaufort = wind->add_option("--beaufort", w.beaufort, "Mean speed by Beaufort number (0 to 12)");
  CLI::Option* velocity =
      wind->add_option("--velocity", w.velocity, "Mean as a vector X Y Z TOWARDS which the air moves, m/s")
          ->expected(3);
  speed->excludes(beaufort)->excludes(velocity);
  beaufort->excludes(velocity);
  wind->add_option("--from", w.from, "Direction it blows FROM, degrees clockwise from north (0 to 360)")
      ->excludes(velocity);
  wind->add_option("--ramp", w.ramp, "Change over so many seconds of simulated time (0 to 3600)");
  wind->add_option("--amplitude", w.amplitude, "Largest gust of each component, m/s (0 to 30)");
  wind->add_option("--length", w.length, "Size of the gusts, m (0.01 to 10000)");
  wind->add_option("--beta", w.beta, "Control factor of the push (0 to 100)");
  wind->add_option("--law", w.law, "How it pushes the water: gust, stress or paper")
      ->check(CLI::IsMember({"gust", "stress", "paper"}));
  wind->add_option("--roughness", w.roughness, "Roughness of the log profile above the sea, m (1e-6 to 5)");
  CLI::Option* period = wind->add_option("--period", w.period, "Pulse: period, s");
  CLI::Option* width = wind->add_option("--width", w.width, "Pulse: how long it blows of each period, s");
  period->needs(width);
  width->needs(period);
  wind->add_flag("--no-pulse", w.no_pulse, "Blow all the time")->excludes(period)->excludes(width);
  wind->add_flag("--off", w.off, "No wind");
}

bool given(const CLI::App& command, const char* option) { return command.count(option) > 0; }

void fill_wind(const CommandLine& line, Request& request) {
  const CLI::App& wind = *line.wind;
  const WindOptions& w = line.options.wind;
  proto::v1::SetWind& set = *request.mutable_set_wind();
  proto::v1::Wind& out = *set.mutable_wind();
  if (given(wind, "--speed")) out.set_speed(w.speed);
  if (given(wind, "--beaufort")) out.set_beaufort(w.beaufort);
  if (given(wind, "--from")) out.set_from_deg(w.from);
  if (given(wind, "--velocity")) {
    out.mutable_velocity()->set_x(w.velocity.at(0));
    out.mutable_velocity()->set_y(w.velocity.at(1));
    out.mutable_velocity()->set_z(w.velocity.at(2));
  }
  if (given(wind, "--amplitude")) out.set_amplitude(w.amplitude);
  if (given(wind, "--length")) out.set_length(w.length);
  if (given(wind, "--beta")) out.set_beta(w.beta);
  if (given(wind, "--law"))
    out.set_law(w.law == "gust"     ? proto::v1::Wind::GUST
                : w.law == "stress" ? proto::v1::Wind::STRESS
                                    : proto::v1::Wind::PAPER);
  if (given(wind, "--roughness")) out.set_roughness(w.roughness);
  if (given(wind, "--period")) {
    out.mutable_pulse()->set_period(w.period);
    out.mutable_pulse()->set_width(w.width);
  }
  if (given(wind, "--ramp")) set.set_ramp(w.ramp);
  if (w.no_pulse) set.set_clear_pulse(true);
}

/// The request of every command but events.
Request to_request(const CommandLine& line) {
  Request request;
  if (line.status->parsed()) request.mutable_get_status();
  if (line.pause->parsed()) request.mutable_pause();
  if (line.resume->parsed()) request.mutable_resume();
  if (line.step->parsed()) request.mutable_step()->set_steps(line.options.steps);
  if (line.wind->parsed() && line.options.wind.off) request.mutable_clear_wind();
  if (line.wind->parsed() && !line.options.wind.off) fill_wind(line, request);
  return request;
}

/// A flag that stands alone, or at least one option: CLI11 cannot say it.
std::string wind_usage_fault(const CommandLine& line) {
  if (!line.wind->parsed()) return "";
  std::size_t options = 0;
  for (const CLI::Option* option : line.wind->get_options()) {
    if (option->count() > 0) ++options;
  }
  if (options == 0) return "wind: say what to change, e.g. --speed 12 --from 270, or --off";
  if (line.options.wind.off && options > 1) return "wind: --off stands alone";
  return "";
}

std::string error_text(const proto::v1::Error& error) {
  return error.message() + " [" + proto::v1::Error::Code_Name(error.code()) + "]";
}

int print_error(const proto::v1::Error& error, bool json, std::ostream& out, std::ostream& err) {
  if (json) out << nlohmann::ordered_json{{"ok", false}, {"error", to_json(error)}}.dump() << "\n";
  err << "pelagos-ctl: refused: " << error_text(error) << "\n";
  return 1;
}

int print_response(const Response& response, bool json, std::ostream& out, std::ostream& err) {
  if (response.has_error()) return print_error(response.error(), json, out, err);
  if (response.has_status()) {
    if (json) {
      out << to_json(response.status()).dump() << "\n";
    } else {
      out << describe(response.status());
    }
    return 0;
  }
  if (json) {
    out << R"({"ok":true})"
        << "\n";
  } else {
    out << "done\n";
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
  while (options.event_count == 0 || count < options.event_count) {
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
      out << describe(*event) << "\n";
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
  if (const std::string fault = wind_usage_fault(line); !fault.empty()) {
    err << "pelagos-ctl: " << fault << "; see pelagos-ctl wind --help\n";
    return 2;
  }
  const EndpointResult server = parse_endpoint(options.server);
  if (!server.endpoint || server.endpoint->port == 0) {
    err << "pelagos-ctl: --server: "
        << (server.endpoint ? "port 0 is none to connect to; allowed: 1 to 65535" : server.error) << "\n";
    return 2;
  }
  ControlClient client(*server.endpoint, std::chrono::milliseconds(static_cast<std::int64_t>(options.timeout * 1e3)));
  if (line.events->parsed()) return follow_events(client, options, out, err);
  return print_response(client.ask(to_request(line)), options.json, out, err);
}

}  // namespace

int run_ctl(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  CommandLine line;
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return line.app.exit(error, out, err) == 0 ? 0 : 2;
  }
  try {
    return run_command(line, out, err);
  } catch (const std::exception& error) {
    if (line.options.json) {
      out << nlohmann::ordered_json{{"ok", false}, {"error", {{"code", "UNREACHABLE"}, {"message", error.what()}}}}
                 .dump()
          << "\n";
    }
    err << "pelagos-ctl: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace pelagos
