#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics/particles.hpp"

namespace pelagos {

// Rigid bodies inside the pressure solve. A body that moves only after the solve first bears the weight of all the
// water around it, and a light one is thrown away. So each body follows every trial pressure p of the solve. From its
// boundary samples b, of volume V_b and at r_b from its centre of mass, it gets
//   G_ik = sum_b a_ib ,  H_ik = sum_b r_b x a_ib                       of particle i and body k, see pair_passes.hpp
//   u_k = rho_ref V M_k^-1 sum_i p_i G_ik ,  turn_k = rho_ref V I_k^-1 sum_i p_i H_ik
//   (J u)_i -= u_k . G_ik + turn_k . H_ik
// velocity and angular velocity, and the water's constraint i changes. That adds six columns for each body to J, and
// its mass to W. A = J W J' stays symmetric, so conjugate gradients apply, and impulses on body and water are opposite,
// to rounding. (Strong coupling as in Akinci et al. 2012 and Band et al. 2018, there in Jacobi iterations.)

/// A rigid body, as the solves see it. World axes.
struct CoupledBody {
  std::size_t first_sample = 0, sample_count = 0;      ///< its samples among FluidState::moving_position
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< m, local: of mass; moments are about it
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, of `centre`: without the water's impulse, then with it
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< rad/s, likewise
  /// 1/kg for each axis and 1/(kg m^2) about `centre`; zero along what is prescribed.
  Eigen::Vector3d inverse_mass = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();

  // What a step has done; set to zero before it.
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();          ///< N s, of the water on the body
  Eigen::Vector3d angular_impulse = Eigen::Vector3d::Zero();  ///< N m s, about `centre`
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();     ///< m, beyond the place that the samples were given
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();             ///< rad, likewise

  [[nodiscard]] bool answers() const { return !inverse_mass.isZero(0.0) || !inverse_inertia.isZero(0.0); }
};

/// A particle within the support of a body's samples.
struct BodyContact {
  std::uint32_t particle = 0, body = 0;
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();  ///< G_ik, 1/m
  Eigen::Vector3f moment = Eigen::Vector3f::Zero();    ///< H_ik, no unit
};

/// A small motion, or a velocity.
struct BodyMotion {
  Eigen::Vector3d way = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
};

/// A moving boundary sample, or its image beyond a mirrored or periodic face.
struct BodySample {
  std::int32_t body = -1;    ///< -1: none
  std::uint32_t source = 0;  ///< among FluidState::moving_position
  Float4 sign{1, 1, 1, 1};   ///< of the image
};

/// Where water ends at open edges, bodies and particles cease to meet: what they give each other counts with a share
/// that falls from 1 to 0 towards the edge. Both ways alike, so that the third law and the solve's symmetry stand.
struct CouplingFade {
  static constexpr float kFar = std::numeric_limits<float>::max();
  std::array<float, 2> low{-kFar, -kFar}, high{kFar, kFar};  ///< m, local: the edges across x, y, where they are open
  float start = 0.0F;                                        ///< m inside the nearest edge: up to here the share is 0
  float width = 0.0F;                                        ///< m: over which it comes to 1; 0: it is 1 everywhere

  [[nodiscard]] bool acts() const { return width > 0.0F; }
  [[nodiscard]] float share(float x, float y) const {
    if (!acts()) return 1.0F;
    const float inside = std::min({x - low[0], high[0] - x, y - low[1], high[1] - y});
    const float t = std::clamp((inside - start) / width, 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
  }
};

/// All bodies of the water and their contacts at the present lists.
struct BodyCoupling {
  std::vector<CoupledBody> bodies;    ///< set before each step by whoever moves them
  std::vector<BodyContact> contacts;  ///< by particle
  std::vector<BodySample> samples;    ///< every moving sample and image, in the walls' order
  CouplingFade fade;

  [[nodiscard]] bool empty() const { return bodies.empty(); }
};

/// sum_i p_i G_ik and sum_i p_i H_ik of every body, m and m^2 for p in m^2.
void sum_pressure(const BodyCoupling& coupling, std::span<const float> pressure, std::vector<BodyMotion>& sums);

/// What the bodies answer to a pressure: u_k and turn_k. @param particle_mass  rho_ref V, kg
void answer_pressure(const BodyCoupling& coupling, std::span<const float> pressure, double particle_mass,
                     std::vector<BodyMotion>& motions);

/// rate_i -= way_k . G_ik + turn_k . H_ik
void add_body_rates(const BodyCoupling& coupling, std::span<const BodyMotion> motions, std::span<float> rate);

}  // namespace pelagos
