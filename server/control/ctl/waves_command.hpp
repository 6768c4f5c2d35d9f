#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "commands.pb.h"

namespace pelagos {

/// The command `waves` on the command line.
struct WavesCommand {
  CLI::App* waves = nullptr;
  std::vector<std::string> wave;  ///< AMPLITUDE,LENGTH,TO[,PHASE] of each
  std::string file;
  double blend = 0.0;  ///< s
  bool off = false;

  void add_to(CLI::App& app);
  /// What is wrong that CLI11 cannot say; empty if nothing.
  [[nodiscard]] std::string usage_fault() const;
  /// Fills in the command. @return what is wrong with a wave or the file; empty if nothing
  [[nodiscard]] std::string fill(proto::v1::SetWaves& out) const;
};

}  // namespace pelagos
