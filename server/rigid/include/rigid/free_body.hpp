#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "rigid/body_mass.hpp"
#include "values/body.hpp"
#include "values/freedoms.hpp"

namespace pelagos {

/// A body of mass in motion, with all six freedoms or some of them. World axes; its position is that of its centre of
/// mass. The water's push comes from elsewhere (physics/coupling.hpp), in three moves a step:
/// `predict` where it would go without, let the water push, `take` what it did.
class FreeBody {
 public:
  /// Whether a step moves with the velocity before gravity has acted (as the corrected scheme moves water) or after.
  enum class Order { kDriftFirst, kGravityFirst };

  FreeBody() = default;  ///< to be read into
  /// @param start     of the body's origin, velocities included
  /// @param freedoms  along and about the others its velocities stay as they are, or follow `lead`
  FreeBody(const BodyState& start, const BodyMass& mass, const Freedoms& freedoms = {});

  /// Moves the body by dt under gravity (m/s^2, along -z) alone. Rotation keeps the angular momentum: bodies that turn
  /// freely neither gain nor lose it.
  void predict(double dt, double gravity, Order order);

  /// Takes place, heading and their rates from where the body is led; the other freedoms are kept.
  void lead(const BodyState& leader);

  /// Takes the velocities away, but for those that are led: where there is no water, nothing carries it and it does not
  /// fall either.
  void rest() { velocity_ = angular_velocity_ = Eigen::Vector3d::Zero(); }

  /// Adds what the water did beyond the prediction: a displacement of the centre, a turn, and the velocities after it.
  void take(const Eigen::Vector3d& displacement, const Eigen::Vector3d& turn, const Eigen::Vector3d& velocity,
            const Eigen::Vector3d& angular_velocity);

  /// Position, orientation and velocities of the body's origin; its other fields are left alone.
  void write_to(BodyState& state) const;

  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const Eigen::Quaterniond& orientation() const { return orientation_; }  ///< body to world
  [[nodiscard]] const Eigen::Vector3d& velocity() const { return velocity_; }
  [[nodiscard]] const Eigen::Vector3d& angular_velocity() const { return angular_velocity_; }
  [[nodiscard]] const BodyMass& mass() const { return mass_; }
  [[nodiscard]] const Freedoms& freedoms() const { return freedoms_; }

  /// What a push changes: 1/kg for each axis, and 1/(kg m^2) about the centre. Zero along what is not free.
  [[nodiscard]] Eigen::Vector3d inverse_mass() const;
  [[nodiscard]] Eigen::Matrix3d inverse_inertia() const;
  [[nodiscard]] Eigen::Vector3d angular_momentum() const { return inertia() * angular_velocity_; }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("mass", self.mass_);
    visit("free_along", self.freedoms_.along);
    visit("free_about", self.freedoms_.about);
    visit("centre", self.centre_);
    visit("velocity", self.velocity_);
    visit("angular_velocity", self.angular_velocity_);
    visit("orientation", self.orientation_);
  }

 private:
  [[nodiscard]] Eigen::Matrix3d inertia() const;  ///< world axes
  void drift(double dt);

  BodyMass mass_;
  Freedoms freedoms_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero(),
                  angular_velocity_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
};

}  // namespace pelagos
