#include "command_line.hpp"

#include <sstream>

#include "command_line/number_check.hpp"
#include "help_text.hpp"
#include "messages/limits.hpp"
#include "messages/parse_text.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

using proto::v1::Request;
using proto::v1::TimedCommand;

constexpr const char* kExamples = R"(Examples:
  pelagos-ctl status                                   how the server is doing
  pelagos-ctl status --json                            the same for machines
  pelagos-ctl wind --speed 12 --from 270               12 m/s from the west, at once
  pelagos-ctl wind --beaufort 7 --from 200 --ramp 10   rising to force 7 within 10 s
  pelagos-ctl wind --from 290                          the wind veers, all else stays
  pelagos-ctl wind --period 8 --width 3                blows 3 s of every 8 s
  pelagos-ctl wind --off --at 600                      calm, 600 s into the simulation
  pelagos-ctl wind-at 12 -4 10                         what an anemometer there would read
  pelagos-ctl surface --at 120,-35 --at=-900,0 --ahead 2   the water's surface there in 2 s
  pelagos-ctl current --speed 1.5 --to 90 --ramp 60    1.5 m/s, setting to the east
  pelagos-ctl waves --wave 1.2,60,270 --wave 0.4,5s,250 --blend 30  two waves, in place of all others within 30 s
  pelagos-ctl sea --hs 2 --tp 7 --to 250 --swell 1.5,12,300 --blend 60   a wind sea and a swell within a minute
  pelagos-ctl sea --beaufort 6 --to 90 --blend 120     what a wind of force 6 raises on the open sea
  pelagos-ctl waves --file swell.txt --blend 60        waves from a file, as they stand in a scene
  pelagos-ctl release hose --from 12 20 8 --rate 60 --duration 30   60 m^3/h of oil for half a minute
  pelagos-ctl spill 12 20 --volume 2 --radius 3        2 m^3 of oil at once
  pelagos-ctl boom north 34 8 40 20 34 32 --draft 0.6  a barrier along three points
  pelagos-ctl skimmer rig 37.5 20 --rate 30            takes oil from there; rig --remove ends it
  pelagos-ctl probe 1 30 5                             measures the waves there
  pelagos-ctl schedule                                 the commands that wait for their time, with their numbers
  pelagos-ctl cancel 3                                 the one with number 3 in that list will not be done
  pelagos-ctl pause; pelagos-ctl step 10; pelagos-ctl resume
  pelagos-ctl events --count 5                         the next five events
  pelagos-ctl --server 192.168.1.20:7410 status

Exit status: 0 done; 1 refused or not reachable; 2 wrong command line.)";

/// The lines of the examples that a command has part in.
std::string examples_of(const std::string& command) {
  const std::string start = "pelagos-ctl " + command;
  std::istringstream examples(kExamples);
  std::string found;
  for (std::string line; std::getline(examples, line);) {
    const std::size_t at = (line + " ").find(start + " "), mark = line.find(start + ";");
    if (at != std::string::npos || mark != std::string::npos) found += "\n" + line;
  }
  return found.empty() ? "" : "Examples:" + found;
}

bool given(const CLI::App& command, const char* option) { return command.count(option) > 0; }

void fill_vector(const std::vector<double>& from, proto::v1::Vector& to) {
  to.set_x(from.at(0));
  to.set_y(from.at(1));
  if (from.size() > 2) to.set_z(from.at(2));
}

void fill_places(const std::vector<double>& places, proto::v1::QueryWind& query) {
  for (std::size_t i = 0; i + 2 < places.size(); i += 3)
    fill_vector({places[i], places[i + 1], places[i + 2]}, *query.add_position());
}

void fill_wind(const CommandLine& line, proto::v1::SetWind& set) {
  const CLI::App& wind = *line.wind;
  const WindOptions& w = line.options.wind;
  proto::v1::Wind& out = *set.mutable_wind();
  if (given(wind, "--speed")) out.set_speed(w.speed);
  if (given(wind, "--beaufort")) out.set_beaufort(w.beaufort);
  if (given(wind, "--from")) out.set_from_deg(w.from);
  if (given(wind, "--velocity")) fill_vector(w.velocity, *out.mutable_velocity());
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

void fill_current(const CommandLine& line, proto::v1::SetCurrent& set) {
  const CLI::App& current = *line.current;
  const CurrentOptions& c = line.options.current;
  proto::v1::Current& out = *set.mutable_current();
  if (given(current, "--speed")) out.set_speed(c.speed);
  if (given(current, "--to")) out.set_to_deg(c.to);
  if (given(current, "--velocity")) fill_vector(c.velocity, *out.mutable_velocity());
  if (c.shear == "linear") out.set_shear(proto::v1::Current::LINEAR);
  if (c.shear == "power") out.set_shear(proto::v1::Current::SEVENTH_POWER);
  if (given(current, "--depth")) out.set_depth(c.depth);
  if (given(current, "--relaxation")) out.set_relaxation(c.relaxation);
  if (given(current, "--ramp")) set.set_ramp(c.ramp);
}

std::string read_command_text(const std::string& text, TimedCommand& command) {
  ParsedText parsed;
  parse_text(text, command, parsed);
  if (parsed.faults.empty()) return "";
  const TextRefusal& fault = parsed.faults.front();
  const std::string place = fault.column > 0 ? " character " + std::to_string(fault.column) + ":" : "";
  return "command:" + place + " " + to_string(fault.refusal);
}

/// --off or a time stands alone; everything else says what to change.
std::string fault_of_change(const CLI::App& command, bool off, const char* example) {
  std::size_t options = 0;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0 && option->get_name() != "--at") ++options;
  }
  const std::string name = command.get_name(), help = "; see pelagos-ctl " + name + " --help";
  if (options == 0) return name + ": say what to change, e.g. " + example + ", or --off" + help;
  if (off && options > 1) return name + ": --off stands alone" + help;
  return "";
}

}  // namespace

CommandLine::CommandLine() {
  add_general_options();
  add_commands();
  add_wind_options();
  add_current_options();
  waves.add_to(app);
  sea.add_to(app);
  surface.add_to(app);
  response.add_to(app);
  for (CLI::App* one : timed()) one->add_option("--at", options.at, "Not now but at this simulated time, s");
  for (CLI::App* one : app.get_subcommands([](CLI::App*) { return true; })) one->footer(examples_of(one->get_name()));
}

std::vector<CLI::App*> CommandLine::timed() const {
  std::vector<CLI::App*> all{wind, current, waves.waves, sea.sea, pause, command};
  for (CLI::App* one : response.all()) all.push_back(one);
  return all;
}

void CommandLine::add_general_options() {
  app.name("pelagos-ctl");
  app.fallthrough();  // --json and --server may stand after the command too
  app.require_subcommand(1);
  app.footer(kExamples);
  app.set_version_flag("--version", std::string("pelagos-ctl ") + kVersion);
  app.add_option("--server", options.server, "Where the server listens, HOST:PORT")
      ->envname("PELAGOS_SERVER")
      ->capture_default_str();
  app.add_option("--timeout", options.timeout, "Longest wait for an answer, s")
      ->check(NumberFrom(0.05, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", options.json, "Print JSON, one object a line");
}

void CommandLine::add_commands() {
  status = app.add_subcommand("status", "Print how the server is doing");
  wind = app.add_subcommand("wind", "Change the wind; what is not given stays as it is");
  wind_at = app.add_subcommand("wind-at", "Print what anemometers would read now");
  current = app.add_subcommand("current", "Set the current");
  pause = app.add_subcommand("pause", "Stop simulated time");
  resume = app.add_subcommand("resume", "Let simulated time go on");
  step = app.add_subcommand("step", "While paused, advance by some time steps");
  command = app.add_subcommand("command", "Give any command, written as in an event of a scene");
  schedule = app.add_subcommand("schedule", "Print the commands that wait for their time");
  cancel = app.add_subcommand(
      "cancel", "Take one command that waits for its time (--at, or an event of the scene) out of the schedule");
  events = app.add_subcommand("events", "Print events as they happen");
  wind_at->add_option("places", options.places, "X Y Z of each place (up to 100), m, world frame: x east, z up")
      ->required()
      ->expected(3, 300);
  step->add_option("steps", options.steps, "How many (1 to 10000)")->capture_default_str();
  command->add_option("text", options.command, "e.g. 'set_current { current { speed: 1 to_deg: 90 } ramp: 30 }'")
      ->required();
  cancel
      ->add_option("id", options.cancelled,
                   "Its number, as `pelagos-ctl schedule` and the answer to the command tell it")
      ->required();
  events->add_option("--count", options.event_count, "Stop after so many")->check(NumberFrom(1.0, 1e15));
  events->add_option("--duration", options.event_duration, "Stop after so many seconds")->check(NumberFrom(0.01, 1e9));
}

void CommandLine::add_wind_options() {
  WindOptions& w = options.wind;
  CLI::Option* speed = wind->add_option("--speed", w.speed, help_with("Mean speed at 10 m, m/s", limits::kWindSpeed));
  CLI::Option* beaufort =
      wind->add_option("--beaufort", w.beaufort, help_with("Mean speed by Beaufort number", limits::kBeaufort));
  CLI::Option* velocity =
      wind->add_option("--velocity", w.velocity, "Mean as a vector X Y Z TOWARDS which the air moves, m/s")
          ->expected(3);
  speed->excludes(beaufort)->excludes(velocity);
  beaufort->excludes(velocity);
  wind->add_option("--from", w.from,
                   help_with("Direction it blows FROM, degrees clockwise from north", limits::kWindFrom))
      ->excludes(velocity);
  wind->add_option("--ramp", w.ramp, help_with("Change over so many seconds of simulated time", limits::kRamp));
  wind->add_option("--amplitude", w.amplitude, help_with("Largest gust of each component, m/s", limits::kGust));
  wind->add_option("--length", w.length, help_with("Size of the gusts, m", limits::kGustLength));
  wind->add_option("--beta", w.beta, help_with("Control factor of the push", limits::kBeta));
  wind->add_option("--law", w.law, "How it pushes the water: gust, stress or paper")
      ->check(OneOf({"gust", "stress", "paper"}));
  wind->add_option("--roughness", w.roughness,
                   help_with("Roughness of the log profile above the sea, m", limits::kRoughness));
  CLI::Option* period = wind->add_option("--period", w.period, "Pulse: period, s");
  CLI::Option* width = wind->add_option("--width", w.width, "Pulse: how long it blows of each period, s");
  period->needs(width);
  width->needs(period);
  wind->add_flag("--no-pulse", w.no_pulse, "Blow all the time")->excludes(period)->excludes(width);
  wind->add_flag("--off", w.off, "No wind");
}

void CommandLine::add_current_options() {
  CurrentOptions& c = options.current;
  CLI::Option* speed = current->add_option("--speed", c.speed, help_with("At the surface, m/s", limits::kCurrentSpeed));
  CLI::Option* to = current->add_option(
      "--to", c.to, help_with("Direction it sets TOWARDS, degrees clockwise from north", limits::kCurrentTo));
  current->add_option("--velocity", c.velocity, "As a vector X Y, m/s")->expected(2)->excludes(speed)->excludes(to);
  current->add_option("--ramp", c.ramp, help_with("Change over so many seconds of simulated time", limits::kRamp));
  current->add_option("--shear", c.shear, "How it falls with depth: none, linear or power (1/7)")
      ->check(OneOf({"none", "linear", "power"}));
  current->add_option("--depth", c.depth,
                      help_with("Where it has fallen to zero, m under the mean level", limits::kCurrentDepth));
  current->add_option("--relaxation", c.relaxation,
                      help_with("Time in which the water follows, s", limits::kRelaxation));
  current->add_flag("--off", c.off, "No current");
}

std::string usage_fault(const CommandLine& line) {
  if (line.wind->parsed()) return fault_of_change(*line.wind, line.options.wind.off, "--speed 12 --from 270");
  if (line.current->parsed()) return fault_of_change(*line.current, line.options.current.off, "--speed 1 --to 90");
  if (line.options.places.size() % 3 != 0)
    return "wind-at: " + std::to_string(line.options.places.size()) +
           " numbers are given; allowed: X Y Z of each place; see pelagos-ctl wind-at --help";
  if (const std::string fault = line.waves.usage_fault(); !fault.empty()) return fault;
  if (const std::string fault = line.sea.usage_fault(); !fault.empty()) return fault;
  return line.response.usage_fault();
}

RequestResult to_request(const CommandLine& line) {
  const CtlOptions& options = line.options;
  RequestResult result;
  Request& request = result.request;
  if (line.status->parsed()) request.mutable_get_status();
  if (line.wind_at->parsed()) fill_places(options.places, *request.mutable_query_wind());
  if (line.surface.surface->parsed()) result.fault = line.surface.fill(*request.mutable_query_surface());
  if (line.schedule->parsed()) request.mutable_get_schedule();
  if (line.cancel->parsed()) request.mutable_cancel_scheduled()->set_id(options.cancelled);

  TimedCommand command;
  if (line.pause->parsed()) command.mutable_pause();
  if (line.resume->parsed()) command.mutable_resume();
  if (line.step->parsed()) command.mutable_step()->set_steps(options.steps);
  if (line.wind->parsed() && options.wind.off) command.mutable_clear_wind();
  if (line.wind->parsed() && !options.wind.off) fill_wind(line, *command.mutable_set_wind());
  if (line.current->parsed() && options.current.off) command.mutable_clear_current();
  if (line.current->parsed() && !options.current.off) fill_current(line, *command.mutable_set_current());
  if (line.command->parsed()) result.fault = read_command_text(options.command, command);
  if (line.waves.waves->parsed()) result.fault = line.waves.fill(*command.mutable_set_waves());
  if (line.sea.sea->parsed()) result.fault = line.sea.fill(command);
  line.response.fill(command);
  for (const CLI::App* timed : line.timed())
    if (timed->parsed() && given(*timed, "--at")) command.set_at(options.at);
  if (command.command_case() != TimedCommand::COMMAND_NOT_SET || line.command->parsed())
    *request.mutable_command() = std::move(command);
  return result;
}

}  // namespace pelagos
