#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "packing/surface_particle.hpp"
#include "schedule/schedule.hpp"
#include "values/body.hpp"
#include "values/body_load.hpp"
#include "values/oil_budget.hpp"
#include "values/probe.hpp"
#include "values/slick.hpp"
#include "values/status.hpp"

namespace pelagos {

/// The oil of a frame.
struct OilSnapshot {
  OilBudget budget;
  std::vector<SlickDisc> discs;
};

/// One frame, as the physics thread hands it to the publisher. Owned by one thread at a time.
struct Snapshot {
  std::uint64_t frame = 0;                           ///< 0, 1, ... one each frame interval of simulated time
  double simulation_time = 0.0;                      ///< s, frame * frame_interval
  std::int64_t wall_time_ns = 0;                     ///< system clock, when the frame was completed
  std::optional<SchedulePiece> schedule;             ///< that the frame made; goes out before it
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, world; particle positions are relative to it
  std::uint32_t total_particles = 0;  ///< in the simulation; the difference to particles.size() was left out
  std::vector<SurfaceParticle> particles;
  std::vector<BodyState> bodies;
  std::vector<BodyLoad> loads;       ///< of the bodies that the water pushes, by body id
  std::vector<ProbeReading> probes;  ///< by id
  std::optional<OilSnapshot> oil;    ///< nothing in a scene without
  ServerStatus status;
};

}  // namespace pelagos
