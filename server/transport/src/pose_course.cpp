#include "transport/pose_course.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {
namespace {

using Eigen::Vector3d;

constexpr double kWindow = 0.5;             ///< s of places that a line is laid through
constexpr std::size_t kLeastPlaces = 3;     ///< where poses come rarely
constexpr double kClosest = 0.008;          ///< s between places that are kept: at most 64 in the window
constexpr double kLargestGap = 2.5;         ///< s: longer without a pose, and the course begins anew
constexpr double kLeastSpan = 0.2;          ///< s at a spacing of 1 m: shorter courses say nothing about velocities
constexpr double kSettling = 2.0;           ///< s in which the velocity may still be on its way up from zero
constexpr double kArrivalSlack = 0.05;      ///< s by which poses may come closer together than they were sent
constexpr double kLargestClockError = 1.0;  ///< s between sender's and server's count of an interval
constexpr double kMostLeaps = 2.0;

double seconds_between(PoseCourse::Clock::time_point from, PoseCourse::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

Vector3d limited(const Vector3d& v, double most) {
  const double length = v.norm();
  return length > most ? Vector3d(v * (most / length)) : v;
}

/// From one orientation to the other, axis times angle, at most pi.
Vector3d turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  const double angle = turn.angle() > EIGEN_PI ? turn.angle() - 2.0 * EIGEN_PI : turn.angle();
  return angle * turn.axis();
}

/// A line through values over time.
struct Slope {
  Vector3d rate = Vector3d::Zero();
  double error = 0.0;  ///< standard error of the rate, by what the values are off the line
};

template <class Places, class Value>
Slope fit_line(const Places& places, Value value) {
  const double n = static_cast<double>(places.size());
  double mean_time = 0.0;
  Vector3d mean = Vector3d::Zero();
  for (const auto& place : places) {
    mean_time += (place.time - places.front().time) / n;
    mean += (value(place) - value(places.front())) / n;
  }
  mean += value(places.front());
  double spread = 0.0;
  Vector3d product = Vector3d::Zero();
  for (const auto& place : places) {
    const double t = place.time - places.front().time - mean_time;
    spread += t * t;
    product += t * (value(place) - mean);
  }
  if (!(spread > 0.0)) return {};
  Slope slope{product / spread, 0.0};
  if (places.size() < 3) return slope;
  double residual = 0.0;
  for (const auto& place : places) {
    const double t = place.time - places.front().time - mean_time;
    residual += (value(place) - mean - slope.rate * t).squaredNorm();
  }
  slope.error = std::sqrt(residual / ((n - 2.0) * spread));
  return slope;
}

/// How far a sent rate may be off that of the places.
struct Tolerance {
  double least;         ///< of the rate's unit
  double rarely;        ///< added for each second between poses, for what happened in between,
  double most_rarely;   ///< but at most so much
  double acceleration;  ///< of the rate: what it may be off its own mean
};
constexpr double kShare = 0.3, kErrors = 3.0;
constexpr double kStillShare = 0.05;  ///< of `least`, for a bridge that sends no velocities

/// The sent rate, or the one of the values where it contradicts them.
template <class Choice, class Places, class Value, class Rate>
Choice choose(const Places& places, Value value, Rate rate, const Tolerance& tolerance) {
  const Slope slope = fit_line(places, value);
  Vector3d mean = Vector3d::Zero();
  bool none_sent = true;
  for (const auto& place : places) {
    mean += rate(place) / static_cast<double>(places.size());
    none_sent = none_sent && rate(place).isZero(0.0);
  }
  const double difference = (mean - slope.rate).norm();
  if (none_sent) {
    const bool moves = difference > kErrors * slope.error + kStillShare * tolerance.least;
    return {moves ? slope.rate : mean, false};
  }
  const double span = places.back().time - places.front().time;
  const double interval = span / static_cast<double>(std::max<std::size_t>(places.size() - 1, 1));
  const double allowed = tolerance.least + kShare * std::max(mean.norm(), slope.rate.norm()) + kErrors * slope.error +
                         std::min(tolerance.rarely * interval, tolerance.most_rarely);
  const bool jumps = (rate(places.back()) - mean).norm() > allowed + 0.5 * tolerance.acceleration * span;
  if (difference > allowed || jumps) return {slope.rate, true};
  return {rate(places.back()), false};
}

}  // namespace

bool PoseCourse::take(BodyPose& pose, bool restart, Clock::time_point now) {
  contradiction_.reset();
  const bool leap = last_ && !follows(pose, restart, now);
  const bool taken = !leap || allow_leap(pose, now);
  noticed_ = now;
  if (!taken) {
    candidate_ = {pose, now};
    return false;
  }
  double seconds = 0.0;
  if (last_ && !leap) {
    const double by_arrival = seconds_between(last_->arrival, now);
    if (restart || pose.time - places_.back().time > kLargestGap || by_arrival > kLargestGap) {
      places_.clear();
      begun_ = now;
    }
    seconds = std::min({restart ? by_arrival : pose.time - last_->pose.time, by_arrival + kArrivalSlack, 1.0});
  } else {
    begin(now);
    if (leap && candidate_ && candidate_->pose.time < pose.time) (void)append(candidate_->pose);
  }
  candidate_.reset();
  last_ = {pose, now};
  if (append(pose)) choose_rates(pose);  // a flood is looked at as often as a fast bridge, and no oftener
  pass_on(pose, seconds, now);
  return true;
}

/// Whether a ship that was not heard of for so long may be so far from where it was expected.
bool PoseCourse::within_reach(const Vector3d& way, const Vector3d& turn, double seconds) const {
  const double passed = std::clamp(seconds, 0.0, 1.0), root = std::sqrt(limits_.spacing);
  return way.norm() <= limits_.leap_spacings * limits_.spacing + limits_.ship_speed * root * passed &&
         turn.norm() <= limits_.leap_turn + limits_.ship_turn / root * passed;
}

/// Whether a ship on the course of the last places can have come to the pose's place. Held against the mean of the
/// course, so that a pose may not go further with each of many steps.
bool PoseCourse::follows(const BodyPose& pose, bool restart, Clock::time_point now) const {
  const double arrived = seconds_between(last_->arrival, now);
  const double sent = pose.time - places_.back().time;
  const double seconds = !restart && std::abs(sent - arrived) < kLargestClockError ? sent : arrived;
  const double n = static_cast<double>(places_.size());
  Vector3d way = pose.position, turn = places_.back().turn + turn_between(orientation_, pose.orientation);
  double age = 0.0;  // s, of the mean
  for (const Place& past : places_) {
    way -= past.position / n;
    turn -= past.turn / n;
    age += (places_.back().time - past.time) / n;
  }
  // A body that stays at the mean does not leap either, whatever its velocity.
  const double onward = age + std::min(seconds, kLargestGap),
               unheard = std::min(seconds, seconds_between(*noticed_, now));
  const Vector3d off_course = way - velocity_ * onward, turned_off = turn - angular_velocity_ * onward;
  return within_reach(off_course.norm() < way.norm() ? off_course : way,
                      turned_off.norm() < turn.norm() ? turned_off : turn, unheard);
}

/// Whether the pose fits the leap before it.
bool PoseCourse::bears_out(const BodyPose& pose, Clock::time_point now) const {
  if (!candidate_) return false;
  const BodyPose& leapt = candidate_->pose;
  return within_reach(pose.position - leapt.position, turn_between(leapt.orientation, pose.orientation),
                      seconds_between(candidate_->arrival, now));
}

bool PoseCourse::allow_leap(const BodyPose& pose, Clock::time_point now) {
  leaps_ = std::min(kMostLeaps, leaps_ + seconds_between(refilled_, now) / limits_.seconds_a_leap);
  refilled_ = now;
  const bool after_silence = !noticed_ || now - *noticed_ > limits_.silence;
  const bool borne_out = bears_out(pose, now);
  if (!(after_silence || borne_out) || leaps_ < 1.0) return false;
  if (!borne_out) candidate_.reset();
  leaps_ -= 1.0;
  return true;
}

void PoseCourse::begin(Clock::time_point now) {
  places_.clear();
  begun_ = now;
  velocity_.setZero();
  angular_velocity_.setZero();
}

/// @return whether it is one more, not in place of one that came just before
bool PoseCourse::append(const BodyPose& pose) {
  Place place{pose.time, pose.position, Vector3d::Zero(), pose.velocity, pose.angular_velocity};
  if (!places_.empty()) place.turn = places_.back().turn + turn_between(orientation_, pose.orientation);
  orientation_ = pose.orientation;
  const bool crowded = places_.size() >= 2 && pose.time - places_[places_.size() - 2].time < kClosest;
  if (crowded)
    places_.back() = place;
  else
    places_.push_back(place);
  while (places_.size() > kLeastPlaces && pose.time - places_.front().time > kWindow) places_.pop_front();
  return !crowded;
}

void PoseCourse::choose_rates(const BodyPose& pose) {
  const double root = std::sqrt(limits_.spacing);
  way_ = turn_ = {};  // a single place bears nothing out
  if (places_.back().time - places_.front().time >= kLeastSpan * std::min(root, 1.0)) {
    way_ = choose<Choice>(
        places_, [](const Place& p) { return p.position; }, [](const Place& p) { return p.velocity; },
        {std::min(root, 1.0), 2.0, 2.0, limits_.acceleration});
    turn_ = choose<Choice>(
        places_, [](const Place& p) { return p.turn; }, [](const Place& p) { return p.angular_velocity; },
        {0.1 / root, 1.0, 1.0, limits_.angular_acceleration / limits_.spacing});
  } else if (places_.size() > 1) {
    way_.rate = limited(pose.velocity, limits_.ship_speed * root);
    turn_.rate = limited(pose.angular_velocity, 1.0 / root);
  }
}

void PoseCourse::pass_on(BodyPose& pose, double seconds, Clock::time_point now) {
  velocity_ += limited(way_.rate - velocity_, limits_.acceleration * seconds);
  angular_velocity_ +=
      limited(turn_.rate - angular_velocity_, limits_.angular_acceleration / limits_.spacing * seconds);
  const bool settled = seconds_between(*begun_, now) > kSettling;
  const auto differs = [&](const Choice& choice, const Vector3d& sent, const Vector3d& passed_on, double least) {
    return choice.contradicts || (settled && !sent.isZero(0.0) &&
                                  (sent - passed_on).norm() > least + kShare * std::max(sent.norm(), passed_on.norm()));
  };
  if (differs(way_, pose.velocity, velocity_, 1.0))
    contradiction_ = {pose.velocity.norm(), velocity_.norm(), false};
  else if (differs(turn_, pose.angular_velocity, angular_velocity_, 0.5))
    contradiction_ = {pose.angular_velocity.norm(), angular_velocity_.norm(), true};
  pose.velocity = velocity_;
  pose.angular_velocity = angular_velocity_;
}

}  // namespace pelagos
