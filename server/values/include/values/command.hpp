#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "values/effort.hpp"
#include "values/wind.hpp"

namespace pelagos {

// What an instructor, or the server's own governor, may ask of a running simulation. Commands are applied at step
// boundaries, in the order of arrival, and logged with the step at which they took effect.

/// Replace the wind; from the present wind linearly over `ramp_seconds` (0: at once).
struct SetWind {
  WindSettings wind;
  double ramp_seconds = 0.0;
};
/// No wind from now on (and no cost for it).
struct ClearWind {};
struct PauseSimulation {};
struct ResumeSimulation {};
/// While paused: advance by so many time steps.
struct StepSimulation {
  std::uint32_t steps = 1;
};

/// From now on steps may be so long and are solved so exactly. The governor's; stations have no such request.
struct SetEffort {
  Effort effort;
  std::string reason;  ///< for the event
};

using Command = std::variant<SetWind, ClearWind, PauseSimulation, ResumeSimulation, StepSimulation, SetEffort>;

/// What happened, for every station and for `event_v1`.
struct Event {
  std::uint64_t sequence = 0;    ///< 1, 2, ... without gaps
  std::uint64_t step = 0;        ///< time step before which it took effect
  double simulation_time = 0.0;  ///< s
  std::string kind;    ///< "wind", "pause", "resume", "step", "pose_stale", "pose_fresh", "governor", "numerical_fault"
  std::string source;  ///< who caused it, e.g. "station 127.0.0.1:40112", "scene", "server"
  std::string text;    ///< one line for people
};

}  // namespace pelagos
