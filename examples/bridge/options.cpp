#include "options.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

#include "command_line/number_check.hpp"
#include "text/decimal.hpp"
#include "version/version.hpp"

namespace pelagos::example {

void describe_options(CLI::App& app, Options& o) {
  app.set_version_flag("--version", std::string("pelagos-example-bridge ") + kVersion);
  app.add_option("--domain", o.dds.domain, "DDS domain")->check(WholeFrom(0, 230))->capture_default_str();
  app.add_option("--dds-config", o.dds.config_file, "Cyclone DDS configuration file (default: loopback)");
  app.add_option("--body", o.body, "id of the body; 1 is own ship")
      ->check(WholeFrom(1, 1000000))
      ->capture_default_str();
  app.add_option("--sender", o.sender, "number that tells this bridge from others")->capture_default_str();
  app.add_option("--duration", o.duration, "s (default: length of the track file, or 60)")->check(NumberFrom(0.0, 1e7));
  app.add_option("--rate", o.rate, "poses a second")->check(NumberFrom(0.1, 1000.0))->capture_default_str();
  app.add_option("--track", o.track_file, "CSV: time,east,north,heading_deg[,up,pitch_deg,roll_deg], s, m, degrees");
  const NumberFrom place(-1e5, 1e5);
  app.add_option("--probe-forward", o.probe_forward,
                 "asks for a wave probe that goes with the ship so far before its origin, m; up to 8 times")
      ->check(NumberFrom(-1000.0, 1000.0))
      ->expected(1, 8);
  app.add_option("--ask", o.ask,
                 "EAST,NORTH of a place, m: asks for the sea's surface there each second, to the horizon; repeatable");
  app.add_option("--ask-ahead", o.ask_ahead, "s ahead of now, by the waves alone")
      ->check(NumberFrom(0.0, SurfaceQuery::kLongestAhead));
  const NumberFrom radius(0.1, 1e5);
  app.add_option("--east", o.oval.east, "built-in oval: centre, m")->check(place)->capture_default_str();
  app.add_option("--north", o.oval.north, "built-in oval: centre, m")->check(place)->capture_default_str();
  app.add_option("--radius", o.oval.radius_east, "built-in oval: half its width, m")
      ->check(radius)
      ->capture_default_str();
  app.add_option("--radius-north", o.radius_north, "built-in oval: half its length, m (default: a circle)")
      ->check(radius);
  app.add_option("--speed", o.oval.speed, "built-in oval: m/s")->check(NumberFrom(0.0, 50.0))->capture_default_str();
  app.add_option("--speed-up", o.oval.speed_up, "built-in oval: s from rest to full speed")
      ->check(NumberFrom(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--water-level", o.oval.up, "built-in oval: m")->check(place)->capture_default_str();
  app.add_option("--draft", o.draft, "built-in oval: the ship's origin is that far below the water level, m")
      ->check(place);
  app.add_option("--heave", o.heave, "m, amplitude (default: 0.1, with a file 0)")->check(NumberFrom(0.0, 20.0));
  app.add_option("--pitch", o.pitch_deg, "degrees, amplitude (default: 1.5, with a file 0)")
      ->check(NumberFrom(0.0, 45.0));
  app.add_option("--roll", o.roll_deg, "degrees, amplitude (default: 3, with a file 0)")->check(NumberFrom(0.0, 60.0));
}

std::optional<SurfaceQuery> make_query(const Options& o) {
  SurfaceQuery query{o.ask_ahead, {}};
  for (const std::string& text : o.ask) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto east = read_decimal(text.substr(0, comma)),
               north = read_decimal(text.substr(std::min(comma + 1, text.size())));
    if (!east || !north) {
      std::fprintf(stderr, "pelagos-example-bridge: --ask %s is no place; allowed: EAST,NORTH, e.g. 120,-35.5\n",
                   text.c_str());
      return std::nullopt;
    }
    query.places.emplace_back(*east, *north);
  }
  const auto fault = o.ask.empty() ? std::nullopt : find_fault(query);
  if (!fault) return query;
  std::fprintf(stderr, "pelagos-example-bridge: --ask: %s\n", to_string(*fault).c_str());
  return std::nullopt;
}

std::optional<Track> make_track(const Options& o) {
  Track track;
  const bool built_in = o.track_file.empty();
  if (built_in) {
    OvalTrack oval = o.oval;
    oval.radius_north = o.radius_north.value_or(oval.radius_east);
    oval.up -= o.draft;
    track.path = oval;
  } else {
    std::ifstream file(o.track_file);
    std::string error = o.track_file + ": cannot be read";
    auto path = file ? read_track(file, o.track_file, error) : std::nullopt;
    if (!path) {
      std::fprintf(stderr, "pelagos-example-bridge: %s\n", error.c_str());
      return std::nullopt;
    }
    track.path = std::move(*path);
  }
  track.sea = {o.heave.value_or(built_in ? 0.1 : 0.0), o.pitch_deg.value_or(built_in ? 1.5 : 0.0),
               o.roll_deg.value_or(built_in ? 3.0 : 0.0)};
  return track;
}

}  // namespace pelagos::example
