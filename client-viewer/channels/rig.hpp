#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "text/refusal.hpp"

namespace pelagos {

/// How a mount follows its body.
enum class MountAttitude {
  kFull,     ///< position, roll, pitch and heading: an eye on the bridge
  kHeading,  ///< horizontal position and heading: a chase camera; z is the height above the world's zero
  kNone,     ///< horizontal position only; the axes stay east, north, up
};

/// Where a rig sits. Eye offsets are in the mount's axes: x forward, y port, z up, metres.
struct Mount {
  std::uint32_t body = 0;  ///< the body it rides on; 0: fixed in the world
  MountAttitude attitude = MountAttitude::kFull;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();  ///< m; in the world frame if body is 0 and heading_deg is 90
  double heading_deg = 90.0;                      ///< of a fixed mount, clockwise from north
  double tilt_deg = 0.0;  ///< pitch of the whole rig, positive up; channels turn about its own up axis
};

/// One screen.
struct Channel {
  std::string name;
  double yaw_deg = 0.0;              ///< positive to starboard
  double pitch_deg = 0.0;            ///< positive up
  double horizontal_fov_deg = 40.0;  ///< degrees
  int guard_px = 96;                 ///< pixels that the fluid passes draw around the picture
  Mount mount;
};

struct Rig {
  std::string name;
  std::vector<Channel> channels;

  /// The channel of that name, or nullptr.
  [[nodiscard]] const Channel* find(const std::string& channel) const;
  /// Names of all channels, separated by commas.
  [[nodiscard]] std::string channel_names() const;
};

/// A rig file that cannot be used. The text has one line for each refusal.
class RigError : public std::runtime_error {
 public:
  explicit RigError(Refusals refusals);

  /// @return all that is wrong; the field is the file, the place in it and the field, e.g. "a.json: channels[1].name"
  [[nodiscard]] const Refusals& refusals() const { return refusals_; }

 private:
  Refusals refusals_;
};

/// Reads a rig from JSON (docs/viewer.md describes the format). A syntax error stops at the first, all other faults are
/// collected and reported together. @throws RigError
[[nodiscard]] Rig parse_rig(const std::string& text, const std::string& file_name);
[[nodiscard]] Rig load_rig(const std::filesystem::path& file);

}  // namespace pelagos
