#pragma once

#include <Eigen/Core>
#include <array>

namespace pelagos {

/// What a free body meets of a current that the particles do not make (walled axes). Horizontal, world axes.
struct DriftSea {
  Eigen::Vector2d current = Eigen::Vector2d::Zero();  ///< m/s, that part of the current, mean over the wetted hull
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();     ///< m/s^2, its change by a ramp
  Eigen::Vector2d water = Eigen::Vector2d::Zero();    ///< m/s, of the particles' surface, where the wind drags it along
  std::array<bool, 2> acts{false, false};             ///< for x, y: whether the axis is walled
  double relaxation = 5.0;                            ///< s, T > 0: CurrentSettings::relaxation
};

/// The body that meets it.
struct DriftingHull {
  double mass = 0.0;                                   ///< kg
  double weight = 0.0;                                 ///< N
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s, of its centre, before the push
  Eigen::Vector3d push = Eigen::Vector3d::Zero();      ///< N, of the particles on the body in this step
};

/// N, horizontal.
struct DriftForce {
  Eigen::Vector2d on_body = Eigen::Vector2d::Zero();
  Eigen::Vector2d on_water = Eigen::Vector2d::Zero();  ///< on the particles at the hull
};

/// Carries a free body with a current that the particles do not make, so that it drifts as slicks do.
///
/// The body then moves through particles that stay, and they resist with a drag D that a moving sea would not make. So
/// body and particles are given
///   F = m s (dU/dt + 4 (U + w - v) / T) - D   and   D ,   D = W - c (W - mean W)
/// with U the current, w the water's own mean drift, v the body's velocity, s the share of its weight that the water
/// carries (0 in the air), and W the particles' push, whose mean is over T / 2. |U + w - v| counts up to |U|. In the
/// mean D = W, so the body's velocity tends to U + w, whatever the drag, and the particles' momentum stays: without
/// their part of D a body in a narrow patch would stir it so that other drifters were carried otherwise. What of W
/// changes within T / 2, the waves, moves the body by the part c, which grows from 0 to 1 over some 4 T: until then the
/// mean is not well known. Below 0.1 m/s both fade with |U|, so that a weak current does not change how a body moves.
/// D follows a measured force, nothing is summed up: a body that a wall stops is pressed on to it by 4 m U / T.
/// Source: own, after the hold on the water's layers in CurrentDrive.
class BodyDrift {
 public:
  /// Takes the push of a step of dt (s).
  DriftForce act(const DriftSea& sea, const DriftingHull& hull, double dt);

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("push", self.push_);
    visit("water", self.water_);
    visit("weight", self.weight_);
    visit("unknown", self.unknown_);
  }

 private:
  Eigen::Vector2d push_ = Eigen::Vector2d::Zero();   ///< N, exponential sums; over weight_ they are means
  Eigen::Vector2d water_ = Eigen::Vector2d::Zero();  ///< m/s
  double weight_ = 0.0;                              ///< of the sums, towards 1
  double unknown_ = 1.0;                             ///< towards 0: what is lacking of c's root
};

}  // namespace pelagos
