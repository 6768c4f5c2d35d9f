#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "values/body.hpp"
#include "values/current.hpp"
#include "values/edge_quality.hpp"
#include "values/effort.hpp"
#include "values/hold_reading.hpp"
#include "values/oil_budget.hpp"
#include "values/sea_request.hpp"
#include "values/surface_query.hpp"
#include "values/wind.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

/// A link of the server that more than its own machine can reach.
struct OpenLink {
  std::string link;   ///< "control 0.0.0.0:7410", "DDS domain 7"
  std::string reach;  ///< in words: who can reach it, what they can do, and what to do about it
};

/// How many poses were refused for one reason.
struct PoseRefusals {
  std::string_view reason;  ///< lives as long as the program
  std::uint64_t count = 0;
};

/// How the record of a run's commands is doing.
struct CommandLogState {
  std::string file;
  std::string fault;        ///< why commands wait, or were lost; empty while all are on their way to the disk
  std::size_t waiting = 0;  ///< lines in memory that the disk has no room for
  std::size_t lost = 0;     ///< lines that there was no room for in memory either
};

/// The waves around the patch.
struct SeaStatus {
  double significant_height = 0.0;  ///< m: of the sea that there is, or that it blends into
  std::uint32_t waves = 0;          ///< components of that sea; 0: flat
  std::optional<WaveComponent> highest;
  double mean_direction = 0.0;        ///< rad, counter-clockwise from x: of the energy, as `WaveComponent::direction`
  double share = 1.0;                 ///< 0..1, that it has by now
  double blend_left = 0.0;            ///< s of simulated time, until it is there in full
  std::uint32_t earlier = 0;          ///< seas before it that still have a share
  std::optional<SeaRequest> request;  ///< where it was asked for by systems
};
[[nodiscard]] SeaStatus sea_status(const WaveField& sea, double time, const std::optional<SeaRequest>& request = {});

/// The health of the server, as published on `status_v2` and answered over the control link. All over the last second
/// unless stated.
struct ServerStatus {
  std::string scene;
  std::uint64_t step = 0;
  std::uint64_t frame = 0;
  double simulation_time = 0.0;  ///< s
  bool starting = false;         ///< the water is being placed and settled: no step has been made
  double settled = 0.0;          ///< 0..1: the part of that which is done
  bool paused = false;
  double real_time_factor = 0.0;             ///< simulated seconds per wall second
  double achievable_real_time_factor = 0.0;  ///< simulated seconds per second spent stepping: above 1 is headroom
  double step_ms = 0.0;                      ///< mean wall time of a step
  double time_step = 0.0;                    ///< s, mean
  std::uint32_t particles = 0;
  std::uint32_t boundary_particles = 0;
  std::uint32_t published_particles = 0;  ///< in the last frame
  double density_error = 0.0;             ///< mean of max(rho/rho0 - 1, 0), fraction
  double largest_density = 0.0;           ///< max of rho/rho0
  double density_iterations = 0.0;
  double divergence_iterations = 0.0;
  std::uint32_t unconverged_steps = 0;  ///< steps in which a constraint met its bound of iterations
  double kinetic_energy = 0.0;          ///< J
  double largest_speed = 0.0;           ///< m/s
  std::uint64_t frames_published = 0;   ///< since the start
  std::uint64_t frames_dropped = 0;     ///< replaced in the mailbox before the publisher took them, since the start
  std::uint64_t poses_accepted = 0;
  std::uint64_t poses_refused = 0;
  std::uint64_t poses_corrected = 0;        ///< of those accepted: the velocity contradicted the places
  std::vector<PoseRefusals> pose_refusals;  ///< since the start, reasons that occurred
  std::vector<OpenLink> open_links;
  std::uint64_t recoveries = 0;  ///< times that the last good state came back after a numerical fault, since the start
  Effort effort;                 ///< that holds now: the scene's own, or the governor's
  bool governed = false;         ///< whether a governor may change it
  bool over_budget = false;      ///< the governor is at its bounds and a frame still takes longer than its budget
  std::optional<WindSettings> wind;               ///< as blowing now (mean, mid-ramp values included)
  std::optional<CurrentSettings> current;         ///< as running now (mid-ramp velocity included)
  std::array<bool, 2> moves_water{false, false};  ///< for x, y: whether the water itself moves with a current
  SeaStatus sea;
  std::optional<EdgeQuality> edges;    ///< nothing where no edge is open
  std::uint32_t scheduled = 0;         ///< commands that wait for their time
  std::uint64_t commands_refused = 0;  ///< at a step boundary, since the start
  std::string last_refusal;            ///< the last of them: when, who, what and why; empty: there is none
  SurfaceQueryCounts surface_queries;
  std::vector<BodyState> bodies;
  std::vector<HoldReading> holds;              ///< of the bodies that have one
  std::vector<std::string> start_notes;        ///< what the operator should know about the start of the scene
  std::optional<OilBudget> oil;                ///< nothing in a scene without
  std::optional<CommandLogState> command_log;  ///< nothing where none is written
};

}  // namespace pelagos
