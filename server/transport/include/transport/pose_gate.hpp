#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "transport/pose_course.hpp"
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
  kLeaps,         ///< the place is one that a ship cannot have reached, and no second pose bears it out
};
inline constexpr std::size_t kPoseFaults = 10;

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
  double spacing = 1.0;                    ///< m, between the scene's particles: the scale of CourseLimits
};

/// Who sent a pose: a bridge is the number that it gives itself, and its participant. Two that give themselves the same
/// number are two.
struct PoseSender {
  std::uint32_t number = 0;
  std::uint64_t participant = 0;
  bool operator==(const PoseSender&) const = default;
};

struct PoseCounters {
  std::uint64_t accepted = 0;
  std::uint64_t corrected = 0;  ///< of those: the velocity contradicted the places and was replaced
  std::array<std::uint64_t, kPoseFaults> refused{};  ///< by PoseFault
  [[nodiscard]] std::uint64_t refused_in_all() const;
};

/// Decides which poses pass. Knows each body's sender and the time of its last pose. Not thread-safe.
class PoseGate {
 public:
  using Clock = std::chrono::steady_clock;

  explicit PoseGate(const std::vector<std::uint32_t>& bodies, const PoseLimits& limits = {});

  /// Empty if `pose` (in ENU) passes; then its orientation is made exactly unit, and its velocities those that its
  /// places bear out. Counts either way.
  [[nodiscard]] std::optional<PoseFault> check(BodyPose& pose, const PoseSender& sender, Clock::time_point now);
  /// How the velocity of the last pose that passed contradicted the places of its body.
  [[nodiscard]] const std::optional<CourseContradiction>& contradiction() const { return contradiction_; }
  /// Who drives a body; number 0 if nobody has yet.
  [[nodiscard]] PoseSender driver_of(std::uint32_t body) const;
  /// Counts a pose that was found faulty before it could be one.
  PoseFault refuse(PoseFault fault) {
    ++counters_.refused[static_cast<std::size_t>(fault)];
    return fault;
  }
  [[nodiscard]] const PoseCounters& counters() const { return counters_; }

 private:
  struct Track {
    explicit Track(const CourseLimits& limits) : course(limits) {}
    PoseSender sender;
    double time = 0.0;
    std::optional<Clock::time_point> heard;
    PoseCourse course;
  };

  [[nodiscard]] std::optional<PoseFault> find_fault(const BodyPose& pose, const PoseSender& sender,
                                                    Clock::time_point now) const;

  PoseLimits limits_;
  std::unordered_map<std::uint32_t, Track> tracks_;
  PoseCounters counters_;
  std::optional<CourseContradiction> contradiction_;
};

}  // namespace pelagos
