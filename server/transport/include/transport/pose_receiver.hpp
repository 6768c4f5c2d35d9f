#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelagos_dds/participant.hpp"
#include "transport/pose_gate.hpp"
#include "values/body.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// A pose that passed, and when it came.
struct ReceivedPose {
  BodyPose pose;  ///< ENU, orientation unit
  std::uint32_t sender = 0;
  std::chrono::steady_clock::time_point arrival{};
};

/// Takes poses off `own_ship_pose_v1`, `body_pose_v1` and `geodetic_pose_v1` on a thread of its own, refuses bad ones
/// (counted, and logged at a limited rate) and keeps the newest of each body. A flood costs that thread, not the
/// simulation.
class PoseReceiver {
 public:
  /// @param bodies ids of the bodies that follow poses; all others are refused.
  /// @param origin of the world, for geodetic poses. Throws DdsError.
  PoseReceiver(std::shared_ptr<DdsParticipant> participant, const std::vector<std::uint32_t>& bodies,
               const GeodeticOrigin& origin = {}, DdsLog log = {}, const PoseLimits& limits = {});
  ~PoseReceiver();
  PoseReceiver(const PoseReceiver&) = delete;
  PoseReceiver& operator=(const PoseReceiver&) = delete;

  /// Fills `poses` with the newest pose of each body for which one has come since the last call; by body id.
  void take_newest(std::vector<ReceivedPose>& poses);
  [[nodiscard]] PoseCounters counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
