#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "commands.pb.h"

namespace pelagos {

/// The command `sea` on the command line: a wind sea, swells beside it, and how it is made.
struct SeaCommand {
  CLI::App* sea = nullptr;
  std::string spectrum;
  double hs = 0.0, tp = 0.0, tz = 0.0, tm = 0.0, to = 0.0, spread = 0.0, spread_at_peak = 0.0, gamma = 0.0, shape = 0.0;
  int douglas = 0, beaufort = 0;
  bool long_crested = false;
  std::vector<std::string> swell;  ///< HS,TP,TO of each
  std::uint32_t components = 0;
  std::uint64_t seed = 0;
  double shortest = 0.0;  ///< m
  bool wind_sea = false;
  double fetch = 0.0, blown_for = 0.0, pace = 0.0;  ///< m; s; 1: as in nature
  double blend = 0.0;                               ///< s
  bool off = false;

  void add_to(CLI::App& app);
  /// What is wrong that CLI11 cannot say; empty if nothing.
  [[nodiscard]] std::string usage_fault() const;
  /// Fills in the command. @return what is wrong with a swell; empty if nothing
  [[nodiscard]] std::string fill(proto::v1::TimedCommand& out) const;

 private:
  [[nodiscard]] bool given(const char* option) const { return sea->count(option) > 0; }
  [[nodiscard]] bool has_main_system() const;
  [[nodiscard]] std::string fault_of_wind_sea() const;
  void fill_main_system(proto::v1::WaveSystem& out) const;
  void fill_wind_sea(proto::v1::WindSea& out) const;
};

}  // namespace pelagos
