#pragma once

#include <string>

#include "server.hpp"

namespace pelagos {

/// Writes what a run reached as JSON, keys with units. Empty on success, else what is wrong.
[[nodiscard]] std::string write_run_report(const std::string& file, const ServerSummary& summary);

}  // namespace pelagos
