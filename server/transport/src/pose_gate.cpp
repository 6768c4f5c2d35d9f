#include "transport/pose_gate.hpp"

#include <cmath>
#include <numeric>

namespace pelagos {

std::string_view describe(PoseFault fault) {
  switch (fault) {
    case PoseFault::kUnknownBody:
      return "no body of the scene follows poses under this id";
    case PoseFault::kNotFinite:
      return "a number is not finite";
    case PoseFault::kNotUnit:
      return "the quaternion's length is not 1 within 1 %";
    case PoseFault::kTooFar:
      return "the position is more than 100 km from the world's origin";
    case PoseFault::kTooFast:
      return "the speed is above 200 m/s";
    case PoseFault::kSpinsTooFast:
      return "the angular rate is above 20 rad/s";
    case PoseFault::kTimeNotLater:
      return "the time is not later than that of the pose before";
    case PoseFault::kSecondSender:
      return "another sender drives this body";
    case PoseFault::kNoPlace:
      return "latitude, longitude or height is no place; allowed: -90 to 90 degrees, -180 to 360 degrees, -12 to 100 "
             "km";
    case PoseFault::kLeaps:
      return "the place leaps: a ship cannot have come there since the pose before, and no second pose bears it out";
  }
  return "unknown fault";
}

std::uint64_t PoseCounters::refused_in_all() const {
  return std::accumulate(refused.begin(), refused.end(), std::uint64_t{0});
}

PoseGate::PoseGate(const std::vector<std::uint32_t>& bodies, const PoseLimits& limits) : limits_(limits) {
  CourseLimits course;
  course.spacing = limits.spacing;
  course.silence = limits.silence;
  for (const std::uint32_t body : bodies) tracks_.try_emplace(body, course);
}

std::optional<PoseFault> PoseGate::check(BodyPose& pose, const PoseSender& sender, Clock::time_point now) {
  contradiction_.reset();
  const auto fault = find_fault(pose, sender, now);
  if (fault) return refuse(*fault);
  pose.orientation.normalize();
  Track& track = tracks_.at(pose.body);
  const bool restart = sender != track.sender || pose.time <= track.time;
  if (!track.course.take(pose, restart, now)) return refuse(PoseFault::kLeaps);
  contradiction_ = track.course.contradiction();
  if (contradiction_) ++counters_.corrected;
  track.sender = sender;
  track.time = pose.time;
  track.heard = now;
  ++counters_.accepted;
  return std::nullopt;
}

PoseSender PoseGate::driver_of(std::uint32_t body) const {
  const auto track = tracks_.find(body);
  return track == tracks_.end() ? PoseSender{} : track->second.sender;
}

std::optional<PoseFault> PoseGate::find_fault(const BodyPose& pose, const PoseSender& sender,
                                              Clock::time_point now) const {
  const auto track = tracks_.find(pose.body);
  if (track == tracks_.end()) return PoseFault::kUnknownBody;
  if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite() || !pose.velocity.allFinite() ||
      !pose.angular_velocity.allFinite() || !std::isfinite(pose.time)) {
    return PoseFault::kNotFinite;
  }
  // Comparisons that overflow to infinity refuse as they should.
  if (std::abs(pose.orientation.norm() - 1.0) > limits_.quaternion_tolerance) return PoseFault::kNotUnit;
  if (pose.position.cwiseAbs().maxCoeff() > limits_.largest_coordinate) return PoseFault::kTooFar;
  if (pose.velocity.norm() > limits_.largest_speed) return PoseFault::kTooFast;
  if (pose.angular_velocity.norm() > limits_.largest_angular_speed) return PoseFault::kSpinsTooFast;

  const Track& last = track->second;
  if (!last.heard || now - *last.heard > limits_.silence) return std::nullopt;
  if (sender != last.sender) return PoseFault::kSecondSender;
  if (pose.time <= last.time) return PoseFault::kTimeNotLater;
  return std::nullopt;
}

}  // namespace pelagos
