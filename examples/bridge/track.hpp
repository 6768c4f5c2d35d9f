#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <istream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pelagos::example {

/// Where the ship is at one time. Angles in degrees, as people write them.
struct ShipState {
  double time = 0.0;         ///< s
  double east = 0.0;         ///< m from the world's origin
  double north = 0.0;        ///< m
  double up = 0.0;           ///< m, of the ship's origin
  double heading_deg = 0.0;  ///< clockwise from true north
  double pitch_deg = 0.0;    ///< positive bow up
  double roll_deg = 0.0;     ///< positive to starboard
};

/// A circle or oval, clockwise seen from above, from its northernmost point heading east.
struct OvalTrack {
  double east = 0.0;          ///< m, centre
  double north = 0.0;         ///< m, centre
  double radius_east = 5.0;   ///< m, > 0
  double radius_north = 5.0;  ///< m, > 0
  double speed = 1.0;         ///< m/s, mean over a lap; 0 stays in place
  double up = 0.0;            ///< m
  double speed_up = 0.0;      ///< s, >= 0: from rest to `speed` with an even acceleration
};

/// Waypoints with increasing times, the first at 0; straight lines and even turns in between.
struct FileTrack {
  std::vector<ShipState> points;
};

/// What the sea does to a ship, as three sines; amplitudes.
struct SeaMotion {
  double heave = 0.0;      ///< m
  double pitch_deg = 0.0;  ///< degrees
  double roll_deg = 0.0;   ///< degrees
};

struct Track {
  std::variant<OvalTrack, FileTrack> path;
  SeaMotion sea;
};

/// Reads comma-separated values, in UTF-8. The first line names the columns, in capitals or not: time, east, north,
/// heading_deg are needed, up, pitch_deg, roll_deg may be left out (0), others are ignored, unless they look misspelt.
/// Where semicolons or tabs separate the names, as spreadsheets write them, numbers may have decimal commas. Empty
/// lines and lines that start with # are skipped. On failure an empty result, and `error` says "NAME:LINE: what is
/// wrong and what is allowed".
[[nodiscard]] std::optional<FileTrack> read_track(std::istream& input, const std::string& name, std::string& error);

/// Time of the last waypoint, s; infinite for an oval.
[[nodiscard]] double end_of(const Track& track);

[[nodiscard]] ShipState state_at(const Track& track, double time);

/// The same as a bridge sends it: NED, body x forward, y starboard, z down.
struct NedMotion {
  Eigen::Vector3d position;           ///< m: north, east, down
  Eigen::Quaterniond orientation;     ///< body to NED
  Eigen::Vector3d velocity;           ///< m/s: north, east, down
  Eigen::Vector3d angular_rate_body;  ///< rad/s: roll, pitch and yaw rate
};

/// Velocities by differences over 2 ms.
[[nodiscard]] NedMotion motion_at(const Track& track, double time);

}  // namespace pelagos::example
