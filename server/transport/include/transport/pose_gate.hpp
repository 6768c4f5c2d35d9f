#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "values/body.hpp"

namespace pelagos {

/// Why a pose was refused.
enum class PoseFault : std::uint8_t {
  kUnknownBody,   ///< no body of the scene follows poses under this id
  kNotFinite,     ///< NaN or infinite somewhere
  kNotUnit,       ///< the quaternion's length is not 1
  kTooFar,        ///< position
  kTooFast,       ///< velocity
  kSpinsTooFast,  ///< angular velocity
  kTimeNotLater,  ///< time is not larger than that of the pose before
  kSecondSender,  ///< another sender drives the body and is still heard from
  kNoPlace,       ///< latitude, longitude or height
};
inline constexpr std::size_t kPoseFaults = 9;

/// For people, e.g. "unknown body".
[[nodiscard]] std::string_view describe(PoseFault fault);

/// What is allowed.
struct PoseLimits {
  double largest_coordinate = 1e5;         ///< m from the world's origin, for each axis
  double largest_speed = 200.0;            ///< m/s
  double largest_angular_speed = 20.0;     ///< rad/s
  double quaternion_tolerance = 0.01;      ///< of its length
  std::chrono::milliseconds silence{500};  ///< after that long without an accepted pose, another sender or an earlier
                                           ///< time is taken: a bridge was restarted, or a standby one takes over
};

struct PoseCounters {
  std::uint64_t accepted = 0;
  std::array<std::uint64_t, kPoseFaults> refused{};  ///< by PoseFault
  [[nodiscard]] std::uint64_t refused_in_all() const;
};

/// Decides which poses pass. Knows each body's sender and the time of its last pose. Not thread-safe.
class PoseGate {
 public:
  using Clock = std::chrono::steady_clock;

  explicit PoseGate(const std::vector<std::uint32_t>& bodies, const PoseLimits& limits = {});

  /// Empty if `pose` (in ENU) passes; then its orientation is made exactly unit. Counts either way.
  [[nodiscard]] std::optional<PoseFault> check(BodyPose& pose, std::uint32_t sender, Clock::time_point now);
  /// Counts a pose that was found faulty before it could be one.
  PoseFault refuse(PoseFault fault) {
    ++counters_.refused[static_cast<std::size_t>(fault)];
    return fault;
  }
  [[nodiscard]] const PoseCounters& counters() const { return counters_; }

 private:
  struct Track {
    std::uint32_t sender = 0;
    double time = 0.0;
    std::optional<Clock::time_point> heard;
  };

  [[nodiscard]] std::optional<PoseFault> find_fault(const BodyPose& pose, std::uint32_t sender,
                                                    Clock::time_point now) const;

  PoseLimits limits_;
  std::unordered_map<std::uint32_t, Track> tracks_;
  PoseCounters counters_;
};

}  // namespace pelagos
