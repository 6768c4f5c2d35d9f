#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "commands.pb.h"

namespace pelagos {

/// The commands of oil and its response, and of probes, on the command line. A program runs one of them, so they share
/// the values.
struct ResponseCommands {
  CLI::App* release = nullptr;
  CLI::App* spill = nullptr;
  CLI::App* boom = nullptr;
  CLI::App* skimmer = nullptr;
  CLI::App* probe = nullptr;

  std::string name;
  std::uint32_t id = 0, body = 0;
  std::vector<double> from, to, places;  // m
  double rate = 0, duration = 0, volume = 0, radius = 0, draft = 0, critical_speed = 0;
  bool end = false;  // --stop, --remove

  void add_to(CLI::App& app);
  [[nodiscard]] std::array<CLI::App*, 5> all() const { return {release, spill, boom, skimmer, probe}; }

  /// What is wrong that CLI11 cannot say; empty if nothing.
  [[nodiscard]] std::string usage_fault() const;
  /// Fills in the command that was given, if one of these was.
  void fill(proto::v1::TimedCommand& command) const;

 private:
  void add_release(CLI::App& app);
  void add_spill(CLI::App& app);
  void add_boom(CLI::App& app);
  void add_skimmer(CLI::App& app);
  void add_probe(CLI::App& app);
  void fill_release(proto::v1::TimedCommand& command) const;
  void fill_spill(proto::v1::SpillOil& out) const;
  void fill_boom(proto::v1::TimedCommand& command) const;
  void fill_skimmer(proto::v1::TimedCommand& command) const;
  void fill_probe(proto::v1::TimedCommand& command) const;
};

}  // namespace pelagos
