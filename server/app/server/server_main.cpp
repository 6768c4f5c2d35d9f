#include <csignal>

#include <CLI/CLI.hpp>
#include <atomic>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "command_line/stop_signals.hpp"
#include "control/endpoint.hpp"
#include "files/asset_folder.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "machine.hpp"
#include "run_report.hpp"
#include "scene/command_log.hpp"
#include "scene/read_scene.hpp"
#include "server.hpp"
#include "server_log.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void request_stop(int) { stop_requested.store(true); }

struct Arguments {
  std::string scene_file, control = "127.0.0.1:7410", report_file, log_level = "info", replay_file, state_file,
                          body_frame = "enu";
  std::vector<std::string> assets;
  ServerOptions options;
  bool unpaced = false;
};

void add_options(CLI::App& app, Arguments& arguments) {
  ServerOptions& options = arguments.options;
  app.add_option("--scene", arguments.scene_file, "Scene file (see docs/scenes.md)")->required();
  app.add_option(
         "--assets", arguments.assets,
         "Folder with meshes, or with meshes/, that scenes name; repeatable (default: the installed assets only)")
      ->allow_extra_args(false)
      ->check(FolderThatExists());
  app.add_option("--domain", options.domain, "DDS domain")->check(WholeFrom(0, 230));
  app.add_option("--control", arguments.control, "Address of the instructors' link; port 0 takes a free one")
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads that advance the water (default: all)")
      ->check(WholeFrom(1, 256));
  app.add_option("--duration", options.duration, "End after so many seconds: wall clock, or simulated with --unpaced")
      ->check(NumberFrom(0.0, 1e9));
  app.add_flag("--unpaced", arguments.unpaced, "As fast as it goes instead of at the wall clock's pace");
  app.add_option("--dds-config", options.dds_config,
                 "Cyclone DDS configuration (default: CYCLONEDDS_URI, else this machine only)");
  app.add_option("--body-frame", arguments.body_frame,
                 "World frame and body axes of the bodies' states and loads that are published")
      ->check(OneOf({"enu", "ned"}))
      ->capture_default_str();
  app.add_option("--report", arguments.report_file, "Write what the run reached there, as JSON, at the end");
  app.add_option("--command-log", options.command_log,
                 "Write every input there (commands, poses, requests for probes), with the step before which it was "
                 "applied; see --replay");
  app.add_option("--replay", arguments.replay_file,
                 "Repeat the run of this command log: its commands at its steps, to its end; gives the same bits");
  app.add_option("--save-state", options.save_state,
                 "Save the whole state there at the end, for --load-state of another run of the same scene");
  app.add_option("--load-state", arguments.state_file,
                 "Go on from this saved state: with the same bits as if the run that saved it had not ended");
  app.add_option("--log-level", arguments.log_level, "Least level to log")
      ->check(OneOf({"debug", "info", "warning", "error"}))
      ->capture_default_str();
}

/// Whether what the run leaves behind can be written: tried before it, not found out after it. False is said.
bool try_outputs(const Arguments& arguments) {
  const auto good = [](const char* option, const std::string& file, const std::string& fault) {
    if (!file.empty() && !fault.empty())
      std::cerr << "pelagos-server: " << option << " " << file << ": " << fault << '\n';
    return file.empty() || fault.empty();
  };
  const std::string& log = arguments.options.command_log;
  const bool report_good = good("--report", arguments.report_file, fault_of_output_file(arguments.report_file));
  const std::string& state = arguments.options.save_state;
  const bool state_good = good("--save-state", state, fault_of_output_file(state));
  return good("--command-log", log, fault_of_output_file(log)) && report_good && state_good;
}

/// Reads the state that the run goes on from; false if it cannot be read (said).
bool read_state(Arguments& arguments) {
  constexpr std::size_t kLargestState = std::size_t{4} << 30;  // bytes
  if (arguments.state_file.empty()) return true;
  InputFile file = read_input_file(arguments.state_file, "state", kLargestState);
  if (file.fault.empty() && file.bytes.empty()) file.fault = "is empty";
  if (file.fault.empty() && file.bytes.size() > kLargestState) file.fault = "has more than 4 GiB";
  if (file.fault.empty()) {
    arguments.options.start_state = std::move(file.bytes);
    return true;
  }
  std::cerr << "pelagos-server: --load-state " << arguments.state_file << ": " << file.fault
            << "; allowed: a file that --save-state has written\n";
  return false;
}

/// Fills the options from scene file and addresses; false if something is wrong (said).
bool prepare(Arguments& arguments) {
  if (!try_outputs(arguments)) return false;
  SceneReadOptions reading;
  reading.asset_roots = mesh_folders(arguments.assets);
  SceneResult scene = read_scene_file(arguments.scene_file, reading);
  if (!scene) {
    std::cerr << "pelagos-server: cannot use the scene:\n" << scene.report() << '\n';
    return false;
  }
  if (!arguments.replay_file.empty()) {
    CommandLogResult log = read_command_log_file(arguments.replay_file);
    for (const std::string& fault : log.faults) std::cerr << "pelagos-server: --replay: " << fault << '\n';
    if (!log.log) return false;
    arguments.options.replay = std::move(log.log);
  }
  if (!read_state(arguments)) return false;
  const EndpointResult endpoint = parse_endpoint(arguments.control);
  if (!endpoint.endpoint) {
    std::cerr << "pelagos-server: --control " << arguments.control << ": " << endpoint.error << '\n';
    return false;
  }
  arguments.options.scene = std::move(*scene.scene);
  arguments.options.control.host = endpoint.endpoint->host;
  arguments.options.control.port = endpoint.endpoint->port;
  arguments.options.paced = !arguments.unpaced;
  arguments.options.bodies_in_ned = arguments.body_frame == "ned";
  return true;
}

int serve(const Arguments& arguments) {
  Server server(arguments.options, stop_requested);
  const ServerSummary summary = server.run();
  log_info("ended: real-time factor " + std::to_string(summary.run.real_time_factor()) + ", " +
           std::to_string(summary.publisher.published) + " frames published, " +
           std::to_string(summary.publisher.dropped) + " dropped");
  if (!arguments.report_file.empty()) {
    const std::string fault = write_run_report(arguments.report_file, summary);
    if (!fault.empty()) {
      log_error(fault);
      return 1;
    }
  }
  if (summary.log_failed) return 1;
  if (summary.end == ServerEnd::kNumericalFault) return 3;
  if (summary.state_failed) return 1;
  return summary.replay_differs ? 4 : 0;
}

}  // namespace
}  // namespace pelagos

int main(int argc, char** argv) {
  CLI::App app{
      "Ocean simulation server: advances a scene, publishes it over DDS, takes poses and an instructor's orders.\n"
      "Example: pelagos-server --scene scenes/bridge.scene --domain 7 --control 127.0.0.1:7410",
      "pelagos-server"};
  app.set_version_flag("--version", std::string("pelagos-server ") + pelagos::kVersion);
  pelagos::Arguments arguments;
  arguments.options.threads = pelagos::describe_machine().hardware_threads;
  pelagos::add_options(app, arguments);
  if (const auto status = pelagos::parse_command_line(app, argc, argv)) return *status;
  pelagos::on_stop_signals(pelagos::request_stop);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told like a full disk
  try {
    if (!pelagos::prepare(arguments)) return 1;
    pelagos::start_log(arguments.log_level);
    return pelagos::serve(arguments);
  } catch (const std::exception& error) {
    std::cerr << "pelagos-server: " << error.what() << '\n';
    return 1;
  }
}
