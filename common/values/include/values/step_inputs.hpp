#pragma once

#include <string>
#include <vector>

#include "values/body.hpp"
#include "values/command.hpp"

namespace pelagos {

/// A command and who gave it, e.g. "station 127.0.0.1:40112", "scene event 2", "bridge 7", "governor".
struct GivenCommand {
  Command command;
  std::string source;
};

/// A valid pose and who sent it, e.g. "bridge 7".
struct GivenPose {
  BodyPose pose;
  std::string source;
};

/// All that comes into a world from outside before a step: poses, and commands in the order in which they are applied.
/// Bridges' requests for probes are commands. Nothing else changes a world.
struct StepInputs {
  std::vector<GivenPose> poses;
  std::vector<GivenCommand> commands;

  [[nodiscard]] bool empty() const { return poses.empty() && commands.empty(); }
};

}  // namespace pelagos
