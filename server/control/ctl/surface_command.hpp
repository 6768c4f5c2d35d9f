#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "control.pb.h"

namespace pelagos {

/// The command `surface` on the command line.
struct SurfaceCommand {
  CLI::App* surface = nullptr;
  std::vector<std::string> at;  ///< X,Y of each place
  double ahead = 0.0;           ///< s

  void add_to(CLI::App& app);
  /// Fills in the query. @return what is wrong with a place; empty if nothing
  [[nodiscard]] std::string fill(proto::v1::QuerySurface& out) const;
};

/// A table of the places that were asked and what the surface is there.
[[nodiscard]] std::string describe(const proto::v1::QuerySurface& query, const proto::v1::SurfaceAnswer& answer);

}  // namespace pelagos
