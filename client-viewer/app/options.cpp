#include "app/options.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>

#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "files/asset_folder.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

bool read_size(const std::string& text, int& width, int& height) {
  char rest = 0;
  return std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &rest) == 2 && width >= 64 && height >= 36 &&
         width <= 8192 && height <= 8192;
}

constexpr double kMetresPerMile = 1852.0;  // nautical

}  // namespace

std::optional<double> read_utc(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, length = 0;
  const auto reads = [&](const char* format, int fields) {
    length = 0;
    const int read = std::sscanf(text.c_str(), format, &year, &month, &day, &hour, &minute, &second, &length);
    return read >= fields;
  };
  std::string rest;
  if (reads("%4d-%2d-%2dT%2d:%2d:%2d%n", 6) && length > 0) {
    rest = text.substr(static_cast<std::size_t>(length));
  } else {
    second = 0;
    if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &length) != 5)
      return std::nullopt;
    rest = text.substr(static_cast<std::size_t>(length));
  }
  const std::chrono::year_month_day date(std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day)));
  const bool good = (rest.empty() || rest == "Z") && text.find_first_of(" +") == std::string::npos && date.ok() &&
                    year >= 1950 && year <= 2050 && hour >= 0 && hour < 24 && minute >= 0 && minute < 60 &&
                    second >= 0 && second < 60;
  if (!good) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86'400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second;
}

std::optional<Options> read_options(int argc, char** argv, int& exit_code) {
  Options options;
  std::string size = "1280x720";
  CLI::App app{"Draws one channel of a Pelagos simulation, in a window or headless.", "pelagos-viewer"};
  app.set_version_flag("--version", std::string("pelagos-viewer ") + kVersion);
  app.add_option("--channel", options.channel, "channel of the rig to draw")->required();
  app.add_option("--rig", options.rig, "rig file (default: rigs/ship_bridge.json of the assets)");
  app.add_option("--domain", options.domain, "DDS domain")->check(WholeFrom(0, 230))->capture_default_str();
  app.add_option("--dds-config", options.dds_config, "Cyclone DDS XML file (default: loopback of this machine)");
  app.add_option("--assets", options.assets, "folder that holds meshes/ and rigs/")->check(FolderThatExists());
  const auto check_size = [](const std::string& text) -> std::string {
    int width = 0, height = 0;
    return read_size(text, width, height) ? "" : "is " + text + "; allowed: WIDTHxHEIGHT, 64x36 to 8192x8192";
  };
  app.add_option("--size", size, "pixels, WIDTHxHEIGHT")->check(check_size)->capture_default_str();
  const std::map<std::string, Quality> qualities = {
      {"low", Quality::kLow}, {"medium", Quality::kMedium}, {"high", Quality::kHigh}};
  app.add_option_function<std::string>(
         "--quality", [&](const std::string& name) { options.quality = qualities.at(name); },
         "low, medium (default) or high")
      ->check(OneOf({"low", "medium", "high"}));
  app.add_option_function<std::string>(
         "--utc", [&](const std::string& text) { options.weather.utc = read_utc(text); },
         "date and time of day at the simulation's time 0, YYYY-MM-DDTHH:MM: where the sun stands")
      ->check([](const std::string& text) -> std::string {
        return read_utc(text) ? "" : "is " + text + "; allowed: YYYY-MM-DDTHH:MM in UTC, from 1950 to 2050";
      });
  app.add_option("--cloud", options.weather.cloud_oktas, "cloud cover in eighths of the sky")
      ->check(NumberFrom(0.0, 8.0))
      ->capture_default_str();
  double visibility = options.weather.visibility / kMetresPerMile;
  app.add_option("--visibility", visibility, "nautical miles (default: 12.4)")->check(NumberFrom(0.02, 50.0));
  double delay_ms = 1e3 * options.delay, clock_error_ms = 0.0;
  app.add_option("--delay", delay_ms, "ms that pictures are behind the schedule; the same for all channels")
      ->check(NumberFrom(0.0, 1000.0))
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--clock", [&](const std::string& name) { options.trust_host = name == "host"; },
         "measured (default): ask the server for its clock; host: the machines' system clocks agree, as by PTP")
      ->check(OneOf({"measured", "host"}));
  app.add_option("--clock-error", clock_error_ms, "ms that the clock here is read wrong by: a test of what corrects it")
      ->check(NumberFrom(-1e6, 1e6))
      ->capture_default_str();
  app.add_flag("--synthetic", options.synthetic, "draw a made-up sea with a ship, without a server");
  auto* headless = app.add_flag("--headless", options.headless, "no window: write pictures and a report");
  const auto add_headless = [&](const char* name, auto& value, const char* text) {
    return app.add_option(name, value, std::string(text) + " (headless)")->needs(headless)->capture_default_str();
  };
  add_headless("--frames", options.frames, "end after so many frames; 0: no limit");
  add_headless("--duration", options.duration, "end after so many seconds; 0: no limit")->check(NumberFrom(0.0, 1e6));
  add_headless("--every", options.every, "seconds between pictures written; 0: each frame")
      ->check(NumberFrom(0.0, 1e5));
  add_headless("--rate", options.rate, "pictures a second, at most")->check(NumberFrom(0.1, 240.0));
  add_headless("--wait", options.wait, "seconds to wait for a server")->check(NumberFrom(0.0, 1e5));
  add_headless("--out", options.out, "folder for pictures and report");
  app.add_flag("--plain", options.plain, "no words in the pictures: neither PAUSED nor NO SERVER (headless)")
      ->needs(headless);
  app.add_flag("--swaps", options.swaps,
               "write CHANNEL_swaps.csv: when each picture was shown, and its instant (headless)")
      ->needs(headless);
  if (const auto status = parse_command_line(app, argc, argv)) {
    exit_code = *status;
    return std::nullopt;
  }
  options.weather.visibility = kMetresPerMile * visibility;
  options.delay = 1e-3 * delay_ms;
  options.clock_error = 1e-3 * clock_error_ms;
  read_size(size, options.width, options.height);
  if (options.assets.empty()) options.assets = installed_assets();
  if (options.rig.empty()) options.rig = options.assets / "rigs" / "ship_bridge.json";
  return options;
}

}  // namespace pelagos
