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

/// What did not work, a line each: parts of the chain that did nothing or reported errors.
[[nodiscard]] std::vector<std::string> find_failures(const RunFiles& files);

/// What worked, but too slowly for the machine, a line each: a sea slower than real time, frames dropped or missed.
[[nodiscard]] std::vector<std::string> find_shortfalls(const RunFiles& files);

/// The content of summary.json. Every value comes from the programs' own reports; docs/operators.md lists the keys.
[[nodiscard]] nlohmann::ordered_json summarise(const RunFiles& files, const RunFacts& facts,
                                               const std::vector<std::string>& faults);

/// The same for people, a few lines.
[[nodiscard]] std::string describe(const nlohmann::ordered_json& summary);

}  // namespace pelagos
