#pragma once

#include <string>
#include <vector>

#include "run_files.hpp"

namespace pelagos {

/// What deploy/demo knows of its own run.
struct RunFacts {
  std::string scene_file;
  std::uint32_t domain = 0;
  double seconds = 0.0;       ///< how long the chain was to run
  double wall_seconds = 0.0;  ///< from the start of the server to its end, start-up and stopping included
};

/// What is wrong with the run, a line each; empty for a run that did all it should.
[[nodiscard]] std::vector<std::string> find_faults(const RunFiles& files);

/// The content of summary.json. Every value comes from the programs' own reports; docs/operators.md lists the keys.
[[nodiscard]] nlohmann::ordered_json summarise(const RunFiles& files, const RunFacts& facts,
                                               const std::vector<std::string>& faults);

/// The same for people, a few lines.
[[nodiscard]] std::string describe(const nlohmann::ordered_json& summary);

}  // namespace pelagos
