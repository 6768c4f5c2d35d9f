#pragma once

#include <Eigen/Core>

namespace pelagos {

/// Sums for the trapped-air potential of Ihmsen et al. (2012, "Unified spray, foam and air bubbles for particle-based
/// fluids", eq. 2): how fast neighbours run into each other,
///   v_diff = sum_j |v_ij| (1 - v^_ij . x^_ij) (1 - |x_ij|/h) ,   x_ij = x_i - x_j, v_ij = v_i - v_j .
/// Here divided by the sum of the weights, which makes it a mean speed and independent of the resolution.
class TrappedAir {
 public:
  /// @param way       x_j - x_i, m   @param velocity  v_j - v_i, m/s
  void add(const Eigen::Vector3f& way, float distance, const Eigen::Vector3f& velocity, float support_radius) {
    if (!(distance > 0.0f)) return;
    const float weight = 1.0f - distance / support_radius;
    closing_ += weight * (velocity.norm() - velocity.dot(way) / distance);
    weight_ += weight;
  }
  /// Mean closing speed, m/s.
  [[nodiscard]] float speed() const { return weight_ > 0.0f ? closing_ / weight_ : 0.0f; }

 private:
  float closing_ = 0, weight_ = 0;
};

}  // namespace pelagos
