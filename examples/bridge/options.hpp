#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pelagos_dds/participant.hpp"
#include "track.hpp"
#include "values/surface_query.hpp"

namespace pelagos::example {

inline constexpr std::uint32_t kOwnShip = 1;

/// The command line of the example bridge.
struct Options {
  DdsSettings dds;
  std::uint32_t body = kOwnShip;
  std::uint32_t sender = 1;
  double duration = 0.0;  // s; 0: the track file's length, or 60
  double rate = 30.0;     // Hz
  std::string track_file;
  OvalTrack oval;
  std::vector<double> probe_forward;  // m before the ship's origin
  std::vector<std::string> ask;       // EAST,NORTH: where the surface is asked for
  double ask_ahead = 0.0;             // s
  double draft = 0.0;
  std::optional<double> radius_north, heave, pitch_deg, roll_deg;
};

void describe_options(CLI::App& app, Options& options);

/// The query of --ask. Empty, and a message on stderr, if one of its texts is no place or the server would refuse it.
[[nodiscard]] std::optional<SurfaceQuery> make_query(const Options& options);

/// Empty, and a message on stderr, if the track file is no good.
[[nodiscard]] std::optional<Track> make_track(const Options& options);

}  // namespace pelagos::example
