#pragma once

#include <vector>

#include "announcer.hpp"
#include "hold_watch.hpp"
#include "simulation/world.hpp"
#include "spill_watch.hpp"
#include "transport/pose_gate.hpp"
#include "values/snapshot.hpp"

namespace pelagos {

/// Looks at each frame for what an instructor should hear of, and tells it once.
class Watches {
 public:
  void look(const World& world, const Snapshot& frame, Announcer& announcer);
  /// What bridges sent that was not taken: one event in ten seconds.
  void look_at_poses(const PoseCounters& poses, Announcer& announcer);
  void look_at_requests(std::uint64_t dropped, Announcer& announcer);
  /// Once: along which axes a current cannot move the water.
  void look_at_current(const World& world);

 private:
  void look_at_health(const std::vector<BodyState>& states, Announcer& announcer);
  void look_at_places(const PatchFrame& frame, const std::vector<BodyState>& states, Announcer& announcer);
  void look_at_oil(const OilBudget& oil, double time, Announcer& announcer);
  /// Tells when the water of an open sea no longer follows the waves around it, and when it does again.
  void look_at_edges(const World& world, Announcer& announcer);

  SpillWatch spill_;
  HoldWatch holds_;
  std::vector<PoseHealth> health_;
  std::vector<bool> outside_;           ///< by body: last seen outside the patch
  std::uint64_t refusals_told_ = 0;     ///< poses refused or corrected at the last event about them
  std::uint64_t requests_dropped_ = 0;  ///< for probes, told so far
  std::int64_t next_refusals_ns_ = 0, next_dropped_ns_ = 0;
  bool closed_axes_noticed_ = false;
  bool edges_off_ = false;
};

}  // namespace pelagos
