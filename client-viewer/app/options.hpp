#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "renderer/renderer.hpp"

namespace pelagos {

/// The command line, checked.
struct Options {
  std::string channel;
  std::filesystem::path rig;     ///< empty: rigs/ship_bridge.json of the assets
  std::filesystem::path assets;  ///< holds meshes/ and rigs/
  std::uint32_t domain = 0;
  std::string dds_config;
  bool headless = false;
  bool synthetic = false;
  std::uint64_t frames = 0;  ///< 0: no limit
  double duration = 0.0;     ///< s; 0: no limit
  double every = 0.0;        ///< s between pictures written; 0: each frame drawn
  double wait = 30.0;        ///< s to wait for a server
  bool plain = false;        ///< no words in the pictures
  double delay = 0.1;        ///< s, of pictures behind the schedule
  bool trust_host = false;   ///< the system clocks of this machine and of the server's agree
  double clock_error = 0.0;  ///< s, that the clock here is read wrong by, for tests
  double rate = 60.0;        ///< pictures a second, at most
  bool swaps = false;        ///< write a line for each picture shown
  std::filesystem::path out = ".";
  int width = 1280, height = 720;
  Quality quality = Quality::kMedium;
  Weather weather;
};

/// Reads the command line. Help, version and mistakes are printed; then there is nothing to run and `exit_code` is set.
[[nodiscard]] std::optional<Options> read_options(int argc, char** argv, int& exit_code);

/// s since 1970 of a date and a time of day in UTC, YYYY-MM-DDTHH:MM, with :SS and Z if wanted; years 1950 to 2050.
[[nodiscard]] std::optional<double> read_utc(const std::string& text);

}  // namespace pelagos
