#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "values/current.hpp"
#include "values/effort.hpp"
#include "values/probe.hpp"
#include "values/spill.hpp"
#include "values/wave_settings.hpp"
#include "values/wind_change.hpp"
#include "waves/wave_system.hpp"

namespace pelagos {

// What an instructor, or the server's own governor, may ask of a running simulation. Commands are applied at step
// boundaries, in the order of arrival, and logged with the step at which they took effect. docs/architecture.md lists
// what a new one needs.

/// Change the wind; from the present wind linearly over `ramp_seconds` (0: at once). What is left out keeps the values
/// of the wind that was last set when the command takes effect.
struct SetWind {
  WindChange wind;
  double ramp_seconds = 0.0;
};
/// No wind from now on (and no cost for it).
struct ClearWind {};
/// Replace the current; its velocity changes from the present one linearly over `ramp_seconds` (0: at once).
struct SetCurrent {
  CurrentSettings current;
  double ramp_seconds = 0.0;
};
/// No current from now on: water that moves with it is slowed down.
struct ClearCurrent {};
/// Exchange all waves around the patch for these, over `blend_seconds` (0: at once).
struct SetWaves {
  std::vector<WaveSettings> waves;  ///< none: a flat sea
  double blend_seconds = 0.0;
};
/// The same by systems, which become components when the command takes effect.
struct SetSea {
  SeaSettings sea;
  double blend_seconds = 0.0;
};
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

/// What concerns oil; see values/spill.hpp.
using OilCommand = std::variant<ReleaseOil, StopRelease, SpillOil, SetBoom, RemoveBoom, SetSkimmer, RemoveSkimmer>;

using Command = std::variant<SetWind, ClearWind, SetCurrent, ClearCurrent, SetWaves, SetSea, PauseSimulation,
                             ResumeSimulation, StepSimulation, SetEffort, SetProbe, RemoveProbe, OilCommand>;

/// A command that a scene gives at a time.
struct SceneEvent {
  double at = 0.0;  ///< s of simulated time, >= 0: it is applied at the first step boundary at or after this
  Command command;
};

/// A command that waits for its time.
struct ScheduledCommand {
  std::uint64_t id = 0;  ///< 1, 2, ... in the order in which they were taken
  double at = 0.0;       ///< s of simulated time
  Command command;
  std::string source;  ///< who gave it
};

/// What happened, for every station and for `event_v1`.
struct Event {
  std::uint64_t sequence = 0;    ///< 1, 2, ... without gaps
  std::uint64_t step = 0;        ///< time step before which it took effect
  double simulation_time = 0.0;  ///< s
  std::string kind;    ///< "wind", "current", "pause", "schedule", "pose_stale", "governor", "numerical_fault", ...
  std::string source;  ///< who caused it, e.g. "station 127.0.0.1:40112", "scene event 2", "server"
  std::string text;    ///< one line for people
};

}  // namespace pelagos
