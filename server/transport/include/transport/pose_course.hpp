#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "values/body.hpp"

namespace pelagos {

/// What consecutive poses of one body may do. Lengths grow with the spacing, speeds with its root: a model in a towing
/// tank and a ship at sea are held to the same.
struct CourseLimits {
  double spacing = 1.0;        ///< m, between particles
  double leap_spacings = 2.5;  ///< beyond what the ship can have moved: further is a leap. A driven body jumps at 5
  double leap_turn = 0.08;     ///< rad, likewise of the orientation: 2.5 spacings at a distance of 30
  double ship_turn = 1.0;      ///< rad/s at a spacing of 1 m, likewise of the angular rate
  double ship_speed = 25.0;    ///< m/s at a spacing of 1 m: what a ship can do, and the most that is believed unseen
  double acceleration = 20.0;  ///< m/s^2, of the velocity that is passed on
  double angular_acceleration = 2.0;  ///< rad/s^2 at a spacing of 1 m, likewise
  double seconds_a_leap = 5.0;        ///< of wall time: so many pass for each leap that is allowed; two may be saved up
  std::chrono::milliseconds silence{500};  ///< a leap after that long without a pose needs no second pose
};

/// The velocity that was sent and the one that the places say, where they contradict each other.
struct CourseContradiction {
  double sent = 0.0, by_places = 0.0;  ///< m/s, or rad/s where `turning`
  bool turning = false;
};

/// The recent poses of one body, and what they say about the next: whether its place can be reached, and whether its
/// velocities are those of its places.
///
/// Places: a pose is a leap where it lies further from the course of the last ones than a ship can have gone. One
/// leap followed by poses that fit is an instructor's reset and is taken with the second of them; at most one in five
/// seconds. A body sent to and fro between two places stays at the first.
///
/// Velocities: a line through the last half second of places (least squares; at low rates through the last three
/// poses) gives their velocity and how sure it is. A sent velocity within the tolerance passes as it is; another one
/// is replaced by that of the places. So noise, jitter and coarse steps of place do no harm, and a bridge that knows
/// no velocities may send zeros. What is passed on starts at zero and changes by `acceleration` at most.
class PoseCourse {
 public:
  using Clock = std::chrono::steady_clock;

  explicit PoseCourse(const CourseLimits& limits) : limits_(limits) {}

  /// Takes a pose that is good by itself, with a time later than the last one's unless the sender is new (`restart`).
  /// @return false: its place is a leap, and it is not taken. Else its velocities are made those to go on with.
  [[nodiscard]] bool take(BodyPose& pose, bool restart, Clock::time_point now);

  /// Of the last pose taken.
  [[nodiscard]] const std::optional<CourseContradiction>& contradiction() const { return contradiction_; }

 private:
  struct Place {
    double time;  ///< s, sender's
    Eigen::Vector3d position;
    Eigen::Vector3d turn;                        ///< rad, since the course began
    Eigen::Vector3d velocity, angular_velocity;  ///< as sent
  };
  /// The rate to aim for, and whether the sent one contradicts the places.
  struct Choice {
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();
    bool contradicts = false;
  };
  struct Heard {
    BodyPose pose;
    Clock::time_point arrival;
  };

  [[nodiscard]] bool follows(const BodyPose& pose, bool restart, Clock::time_point now) const;
  [[nodiscard]] bool bears_out(const BodyPose& pose, Clock::time_point now) const;
  [[nodiscard]] bool within_reach(const Eigen::Vector3d& way, const Eigen::Vector3d& turn, double seconds) const;
  [[nodiscard]] bool allow_leap(const BodyPose& pose, Clock::time_point now);
  void begin(Clock::time_point now);
  bool append(const BodyPose& pose);
  void choose_rates(const BodyPose& pose);
  void pass_on(BodyPose& pose, double seconds, Clock::time_point now);

  CourseLimits limits_;
  std::deque<Place> places_;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();  ///< of the last of them
  std::optional<Heard> last_;                                        ///< taken
  std::optional<Heard> candidate_;                                   ///< a leap that the next pose may bear out
  std::optional<Clock::time_point> noticed_, begun_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), angular_velocity_ = Eigen::Vector3d::Zero();  ///< passed on
  Choice way_, turn_;
  std::optional<CourseContradiction> contradiction_;
  double leaps_ = 2.0;  ///< that may be made now
  Clock::time_point refilled_{};
};

}  // namespace pelagos
