#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "control.pb.h"
#include "response_commands.hpp"
#include "sea_command.hpp"
#include "surface_command.hpp"
#include "waves_command.hpp"

namespace pelagos {

struct WindOptions {
  double speed = 0, from = 0, ramp = 0, amplitude = 0, length = 0, beta = 0, period = 0, width = 0, roughness = 0;
  std::string law;
  int beaufort = 0;
  std::vector<double> velocity;
  bool off = false;
  bool no_pulse = false;
};

struct CurrentOptions {
  double speed = 0, to = 0, ramp = 0, depth = 0, relaxation = 0;
  std::vector<double> velocity;
  std::string shear;
  bool off = false;
};

struct CtlOptions {
  std::string server = "127.0.0.1:7410";
  double timeout = 5.0;
  bool json = false;
  WindOptions wind;
  CurrentOptions current;
  std::vector<double> places;  // x y z of each
  std::string command;         // in Protobuf's text format
  double at = 0.0;             // s, where --at is given
  std::uint32_t steps = 1;
  std::uint64_t cancelled = 0;
  std::uint64_t event_count = 0;  // 0: no limit
  double event_duration = 0.0;    // 0: no limit
};

/// What was asked for, read by the functions below from the parsed command line.
struct CommandLine {
  CLI::App app{
      "Asks a running pelagos-server for its status, and commands it, at once or at a time: wind, current, waves, oil, "
      "pause."};
  CtlOptions options;
  CLI::App* status = nullptr;
  CLI::App* wind = nullptr;
  CLI::App* wind_at = nullptr;
  CLI::App* pause = nullptr;
  CLI::App* resume = nullptr;
  CLI::App* step = nullptr;
  CLI::App* events = nullptr;
  CLI::App* current = nullptr;
  CLI::App* command = nullptr;
  CLI::App* schedule = nullptr;
  CLI::App* cancel = nullptr;
  WavesCommand waves;
  SeaCommand sea;
  SurfaceCommand surface;
  ResponseCommands response;

  CommandLine();
  /// Those that may be given for a time.
  [[nodiscard]] std::vector<CLI::App*> timed() const;

 private:
  void add_general_options();
  void add_commands();
  void add_wind_options();
  void add_current_options();
};

/// What is wrong with the command line that CLI11 cannot say; empty if nothing.
[[nodiscard]] std::string usage_fault(const CommandLine& line);

struct RequestResult {
  proto::v1::Request request;
  std::string fault;  ///< of a command in text format or of its file; empty if there is none
};
/// The request of every command but events.
[[nodiscard]] RequestResult to_request(const CommandLine& line);

}  // namespace pelagos
